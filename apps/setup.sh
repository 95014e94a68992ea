#!/usr/bin/env bash
# Installs what building, testing and reading reports needs; sourced by quickstart.sh and tests/run.sh.
# `setup_packages LIST...` installs missing Debian packages, `setup_plots` fetches the interactive plots.

build_packages=(build-essential cmake ninja-build libeigen3-dev libceres-dev libfmt-dev nlohmann-json3-dev
                libyaml-cpp-dev libcli11-dev libfccp-dev libsqlite3-dev liblz4-dev libzstd-dev libpugixml-dev
                libtomlplusplus-dev)
test_packages=(libgtest-dev chromium poppler-utils jupyter-nbconvert python3-ipykernel python3-matplotlib
               libmujoco-dev libqhull-dev libsdformat-dev liburdfdom-dev)

setup_packages() {
  local package missing=() as_root=()
  for package in "$@"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" != 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "Missing Debian packages: ${missing[*]}. Run this again as root, or install them first." >&2
      return 1
    fi
    as_root=(sudo)
  fi
  echo "Installing Debian packages: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# uPlot makes time series in reports interactive. Without npm or network reports keep their static plots.
setup_plots() {
  local folder=$1/src/ident/report
  [ ! -f "$folder/node_modules/uplot/dist/uPlot.iife.min.js" ] || return 0
  if ! command -v npm >/dev/null; then
    echo "npm is not installed: time series in reports will be static pictures."
  elif ! npm ci --prefix "$folder" --silent --no-audit --no-fund >/dev/null 2>&1; then
    echo "npm ci failed (no network?): time series in reports will be static pictures."
  fi
}

# Release build of the given targets, each folder of the library as one source. On a terminal the build tool shows
# its progress; elsewhere a line says every half minute how far it is, and the compiler's output is shown if it fails.
build_release() {
  local root=$1 log=$1/build/build.log status=0 at
  shift
  mkdir -p "$root/build"
  if ! cmake -S "$root" -B "$root/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DIDENT_UNITY=ON >"$log" 2>&1; then
    tail -n 60 "$log" >&2
    return 1
  fi
  if [ -t 1 ]; then
    cmake --build "$root/build" --target "$@"
    return
  fi
  cmake --build "$root/build" --target "$@" >"$log" 2>&1 &
  local build=$! seconds=0
  while kill -0 "$build" 2>/dev/null; do
    sleep 1
    seconds=$((seconds + 1))
    [ $((seconds % 30)) -eq 0 ] || continue
    at=$(tail -n 1 "$log" | grep -oE '^\[[0-9]+/[0-9]+\]' || true)
    echo "  building ${at:-...}"
  done
  wait "$build" || status=$?
  [ "$status" = 0 ] || tail -n 60 "$log" >&2
  return "$status"
}
