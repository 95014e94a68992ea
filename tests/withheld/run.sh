#!/usr/bin/env bash
# Runs the diagnosis on every case of a campaign, each in a folder of its own that holds nothing but the case.
#
#   run.sh DIR IDENT [ANSWERS]     DIR from withheld_generate; IDENT the program; ANSWERS folder, default answers
#   JOBS=2 LIMIT=120 run.sh ...    processes at a time; seconds that a run may take
#
# Answers that exist are kept, so that an interrupted campaign goes on where it stopped.
set -euo pipefail

if [ $# -lt 2 ]; then
  sed -n '2,7p' "$0" >&2
  exit 2
fi
campaign=$(cd "$1" && pwd)
program=$(command -v "$2") && program=$(readlink -f "$program")
answers=$campaign/${3:-answers}
mkdir -p "$answers"
export campaign program answers LIMIT=${LIMIT:-120}

# diagnose CASE SUFFIX [option ...]: one process that sees a copy of the case only.
diagnose() {
  local name=$1 suffix=$2 folder started ended status=0
  shift 2
  local answer=$answers/$name$suffix
  [ -s "$answer.exit" ] && return 0
  folder=$(mktemp -d)
  cp "$campaign/cases/$name/"{vehicle.yaml,log1.csv,log2.csv} "$folder"
  started=$EPOCHREALTIME
  (cd "$folder" && timeout "$LIMIT" "$program" gap log1.csv log2.csv --vehicle vehicle.yaml --json "$@" \
    >answer.json 2>messages.txt) || status=$?
  ended=$EPOCHREALTIME
  mv "$folder/answer.json" "$answer.json"
  mv "$folder/messages.txt" "$answer.messages"
  awk -v a="$started" -v b="$ended" 'BEGIN { printf "%.3f\n", b - a }' >"$answer.seconds"
  echo "$status" >"$answer.exit"
  rm -r "$folder"
}

one_case() {
  diagnose "$1" ""
  local excluded=$campaign/truth/$1.exclude
  if [ -f "$excluded" ]; then diagnose "$1" .excluded --exclude "$(cat "$excluded")"; fi
}
export -f diagnose one_case

ls "$campaign/cases" | xargs -P "${JOBS:-2}" -I{} bash -euo pipefail -c 'one_case {}'
