#!/usr/bin/env bash
# Makes the data of the sample campaign anew from the true vehicle: data/make_sample.sh [IDENT [FOLDER]].
# The seeds stand here, so the files come out the same.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
ident=$(realpath "${1:-$here/../build/ident}")
folder=$(realpath "${2:-$here/sample}")

cd "$here/sample_truth"
make() {
  local kind=$1 file=$2
  shift 2
  "$ident" simulate "$kind" --vehicle falcon_truth.yaml --output "$folder/$file" "$@" >/dev/null
  echo "$folder/$file"
}
# A stand whose load cells were not set to zero, and one reading in a hundred far off.
make thrust thrust_sweep.csv --seed 1 --set-points 15 --repeats 6 --tare-thrust 0.031 --tare-torque -0.0009 \
  --outliers 0.01 --command u
make motor motor_steps.csv --seed 2 --rate 250 --command u
make inertia pendulum.csv --seed 3 --repeats 8 --platform-mass 0.15 --length 1.2 --amplitude 0.15
# IMU, commands and rotor speeds at 250 Hz; attitude at 125 Hz, position and velocity at 50 Hz from motion capture.
flight=(--rate 250 --attitude-rate 125 --position-rate 50 --noise typical --turbulence 0.2)
make flight flight_mixed.csv --seed 4 --scenario mixed --duration 45 "${flight[@]}"
make flight flight_eight.csv --seed 5 --scenario eight --duration 30 "${flight[@]}"
