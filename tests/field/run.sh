#!/usr/bin/env bash
# Runs refinement and diagnosis on every case of a campaign, each in a folder of its own that holds nothing but the case.
#
#   run.sh DIR IDENT [ANSWERS]     DIR from field_generate; IDENT the program; ANSWERS folder, default answers
#   JOBS=2 LIMIT=600 run.sh ...    processes at a time; seconds that a run may take
#   ONLY=refine run.sh ...         or ONLY=gap: one of the two
#
# Answers that exist are kept, so that an interrupted campaign goes on where it stopped.
set -euo pipefail

if [ $# -lt 2 ]; then
  sed -n '2,8p' "$0" >&2
  exit 2
fi
campaign=$(cd "$1" && pwd)
program=$(command -v "$2") && program=$(readlink -f "$program")
answers=$campaign/${3:-answers}
mkdir -p "$answers"
export campaign program answers LIMIT=${LIMIT:-600} ONLY=${ONLY:-both}

# timed NAME KIND COMMAND...: in the current folder; wall-clock seconds, then processor seconds, then the exit status.
timed() {
  local answer=$answers/$1.$2 status=0
  shift 2
  TIMEFORMAT='%3R %3U %3S'
  { time timeout "$LIMIT" "$@" >answer.json 2>messages.txt || status=$?; } 2>seconds.txt
  mv messages.txt "$answer.messages"
  mv answer.json "$answer.json"
  tail -n 1 seconds.txt >"$answer.seconds"
  echo "$status" >"$answer.exit"
}

# The refined constants are what `--refine` stores in the folder of a campaign.
refine() {
  printf 'vehicle: vehicle.yaml\nlogs: [log1.csv, log2.csv]\n' >ident.yaml
  timed "$1" refine "$program" flightlog --refine --json
  if [ -f parameters.yaml ]; then mv parameters.yaml "$answers/$1.refined.yaml"; fi
  rm -rf ident.yaml .ident
}

diagnose() {
  timed "$1" gap "$program" gap log1.csv log2.csv --vehicle vehicle.yaml --json --write-params better.yaml
  if [ -f better.yaml ]; then mv better.yaml "$answers/$1.better.yaml"; fi
}

one_case() {
  local name=$1 kind folder
  for kind in refine gap; do
    [ "$ONLY" = both ] || [ "$ONLY" = "$kind" ] || continue
    [ -s "$answers/$name.$kind.exit" ] && continue
    folder=$(mktemp -d)
    cp "$campaign/cases/$name/"{vehicle.yaml,log1.csv,log2.csv} "$folder"
    cd "$folder"
    if [ "$kind" = refine ]; then refine "$name"; else diagnose "$name"; fi
    cd /
    rm -r "$folder"
  done
}
export -f timed refine diagnose one_case

ls "$campaign/cases" | xargs -P "${JOBS:-1}" -I{} bash -euo pipefail -c 'one_case {}'
