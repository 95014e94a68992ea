#!/usr/bin/env bash
# Runs the program on every flight and format of a folder that written_generate filled.
#
#   run.sh PROGRAM DIR           answers go to DIR/FLIGHT/answers
#   JOBS=2 LIMIT=600 run.sh ...  flights at a time; seconds that one command may take
#   NO_GAP=1 run.sh ...          without the diagnosis, which takes longest
#
# Answers that exist are kept, so that an interrupted run goes on where it stopped.
set -euo pipefail

if [ $# -lt 2 ]; then
  sed -n '2,8p' "$0" >&2
  exit 2
fi
program=$(readlink -f "$1")
export program LIMIT=${LIMIT:-600}

# kept NAME COMMAND...: output, messages, exit status and seconds of one command.
kept() {
  local answer=answers/$1 status=0 begin=$SECONDS
  shift
  [ -s "$answer.exit" ] && return
  timeout "$LIMIT" "$@" >"$answer.out" 2>"$answer.messages" || status=$?
  echo "$((SECONDS - begin))" >"$answer.seconds"
  echo "$status" >"$answer.exit"
}

one_flight() {
  cd "$1"
  mkdir -p answers
  local log
  for log in log.* full.csv commands.csv; do
    kept "$log.refine" "$program" flightlog "$log" --vehicle vehicle.yaml --refine --json
    case $log in
      log.*)
        kept "$log.log" "$program" log "$log"
        kept "$log.streams" "$program" log "$log" --streams --json
        kept "$log.vehicle" "$program" vehicle "$log"
        [ -n "${NO_GAP:-}" ] || kept "$log.gap" "$program" gap "$log" --vehicle vehicle.yaml
        ;;
    esac
  done
}
export -f kept one_flight

ls -d "$2"/*/ | xargs -P "${JOBS:-1}" -I{} bash -euo pipefail -c 'one_flight {}'
