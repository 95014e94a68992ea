#!/usr/bin/env bash
# The flight kernel and dense products are compiled for several instruction sets. A function that such a file shares
# with the rest of the program may be the one that the linker keeps, and then a plain machine stops with an illegal
# instruction: every function defined there must bear the tag of its instruction set.
#
#   kernel_symbols.sh LIBRARY
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
cd "$scratch"
ar x "$1"
for isa in avx2:IsaAvx2 avx512:IsaAvx512; do
  for object in ./kernel_"${isa%%:*}".cc.o ./dense_rows_"${isa%%:*}".cc.o; do
    shared=$(nm -C --defined-only "$object" | grep -E '^[0-9a-f]+ [TWV] ' |
      grep -vE "${isa##*:}|evaluate_chunk_|ident::dense_rows_|DW.ref" || true)
    if [ -n "$shared" ]; then
      printf '%s shares with the rest of the program:\n%s\n' "$object" "$shared" >&2
      exit 1
    fi
  done
done
