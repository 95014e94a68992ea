#!/usr/bin/env bash
# From a clean clone to a finished report: installs what is missing, builds, identifies the sample vehicle.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=apps/setup.sh
. "$root/apps/setup.sh"

setup_packages "${build_packages[@]}"
setup_plots "$root"
echo "Building ident (some minutes the first time)"
build_release "$root" ident

campaign=$root/out/sample
rm -rf "$campaign"
mkdir -p "$(dirname "$campaign")"
cp -r "$root/data/sample" "$campaign"
cd "$campaign"
ident=$root/build/ident
for step in thrust motor inertia gap "flightlog --refine" slant check; do
  echo "ident $step"
  # shellcheck disable=SC2086
  "$ident" $step >/dev/null
done
"$ident" report --output report.html >/dev/null
echo "Open the report: $campaign/report.html"
