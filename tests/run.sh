#!/usr/bin/env bash
# Installs what is missing, builds Release and runs the tests; ends with ctest's summary.
#
#   tests/run.sh          the quick tests
#   tests/run.sh --all    the slow ones too, as continuous integration does
#   tests/run.sh -R NAME  what is given goes to ctest
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=apps/setup.sh
. "$root/apps/setup.sh"

setup_packages "${build_packages[@]}" "${test_packages[@]}"
setup_plots "$root"
echo "Building ident and its tests (some minutes the first time)"
build_release "$root" all

if [ $# = 0 ]; then set -- -LE slow; fi
if [ "$1" = --all ]; then shift; fi
log=$root/build/ctest.log
status=0
ctest --test-dir "$root/build" --output-on-failure -j "$(nproc)" "$@" >"$log" 2>&1 || status=$?
[ "$status" = 0 ] || grep -vE '^ *[0-9]+/[0-9]+ Test .* Passed|^ +Start ' "$log"
grep -E '^[0-9]+% tests passed|^Total Test time' "$log" || true
exit "$status"
