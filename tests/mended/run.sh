#!/usr/bin/env bash
# Makes each user's wrong file, has it mended from the two logs, and keeps the answers.
#
#   run.sh DIR IDENT [ANSWERS]  DIR from mended_generate; IDENT the program; ANSWERS folder, default answers
#   LIMIT=300 run.sh ...        seconds that a diagnosis may take
#   SPEEDS=no run.sh ...        takes the measured rotor speeds out of the logs; cases without any are left out
#   TARGETS="gz rotorpy" ...    of these targets only
#
# ANSWERS/NNNN/: user_file, fixed_file, answer.json, messages, seconds, exit. Cases with `exit` are kept, so that an
# interrupted campaign goes on where it stopped.
set -euo pipefail

if [ $# -lt 2 ]; then
  sed -n '2,10p' "$0" >&2
  exit 2
fi
campaign=$(cd "$1" && pwd)
program=$(readlink -f "$(command -v "$2")")
answers=$campaign/${3:-answers}
mkdir -p "$answers"

declare -A ending=([gz]=model.sdf [px4-sih]=sih.params [rotorpy]=quad_params.py [mujoco]=model.xml)

for place in "$campaign"/cases/*/; do
  name=$(basename "$place")
  answer=$answers/$name
  [ -s "$answer/exit" ] && continue
  target=$(cat "$place/target")
  [[ " ${TARGETS:-$target} " == *" $target "* ]] || continue
  if [ "${SPEEDS:-yes}" = no ] && ! head -n 1 "$place/log1.csv" | grep -q omega; then continue; fi
  mkdir -p "$answer"
  folder=$(mktemp -d)  # holds nothing but what the user has
  for log in log1.csv log2.csv; do
    if [ "${SPEEDS:-yes}" = no ]; then
      cut -d, -f1-21,26 "$place/$log" >"$folder/$log"
    else
      cp "$place/$log" "$folder"
    fi
  done
  file=${ending[$target]}
  "$program" export "$target" --vehicle "$place/stated.yaml" -o "$folder/$file" >"$answer/export.txt" 2>&1
  (cd "$folder" && "$program" import "$file" -o /dev/null >"$answer/import.txt" 2>&1)
  started=$EPOCHREALTIME status=0
  (cd "$folder" && timeout "${LIMIT:-300}" "$program" gap log1.csv log2.csv --vehicle "$file" --fix "fixed_$file" --json \
    >answer.json 2>messages.txt) || status=$?
  ended=$EPOCHREALTIME
  cp "$folder/$file" "$answer/user_file"
  [ -f "$folder/fixed_$file" ] && cp "$folder/fixed_$file" "$answer/fixed_file"
  mv "$folder/answer.json" "$answer/answer.json"
  mv "$folder/messages.txt" "$answer/messages"
  awk -v a="$started" -v b="$ended" 'BEGIN { printf "%.3f\n", b - a }' >"$answer/seconds"
  echo "$status" >"$answer/exit"
  rm -r "$folder"
done
