#!/usr/bin/env bash
# Executes notebooks against the program that was built: tests/notebooks/run.sh [--update] [NAME...], all without a
# name. Fails when a cell does; 77 when Jupyter is missing. With --update they are kept with their new output, else they stay as they are.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../notebooks" && pwd)
update=false
if [ "${1:-}" = --update ]; then
  update=true
  shift
fi
names=("$@")
if [ ${#names[@]} = 0 ]; then
  for notebook in "$here"/*.ipynb; do names+=("$(basename "$notebook" .ipynb)"); done
fi
if ! /usr/bin/python3 -c 'import nbconvert, ipykernel, matplotlib' 2>/dev/null; then
  echo "jupyter-nbconvert, python3-ipykernel or python3-matplotlib is not installed (tests/run.sh installs them)"
  exit 77
fi
target=$(mktemp -d)
trap 'rm -rf "$target"' EXIT
export IDENT=${IDENT:-$here/../build/ident} IPYTHONDIR=$target/ipython PYDEVD_DISABLE_FILE_VALIDATION=1
export MPLCONFIGDIR=$target/matplotlib PYTHONDONTWRITEBYTECODE=1

for name in "${names[@]}"; do
  (cd "$here" && /usr/bin/python3 -m nbconvert --to notebook --execute --log-level WARN \
    --ExecutePreprocessor.timeout=3000 --ExecutePreprocessor.record_timing=False --output-dir "$target" "$name.ipynb")
  echo "$name runs"
  if $update; then cp "$target/$name.ipynb" "$here/$name.ipynb"; fi
done
