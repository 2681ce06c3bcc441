#!/usr/bin/env bash
# Speed and memory of a segmentation network: milliseconds a picture (reading left out), achieved
# GFLOP/s, and the process's memory after few and many pictures.
# usage: benchmarks/network.sh WEIGHTS [PICTURES...]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
weights="$1"
shift
[ $# -gt 0 ] || set -- 100 1000
gflop="$("$mms" info "$weights" | grep -oP '[0-9.]+(?= GFLOP)')"
echo "$gflop GFLOP a picture"

echo "| threads | pictures | ms a picture | GFLOP/s | MiB |"
echo "| --- | --- | --- | --- | --- |"
for threads in 1 2; do
  for pictures in "$@"; do
    quietly "$mms" segment "sim:crowd?duration=70" --limit "$pictures" --json-only \
      --threads "$threads" --weights "$weights" -o "$out/found"
    ms="$(grep -oP '[0-9.]+(?= ms a picture)' "$out/log")"
    mib="$(grep -oP '[0-9]+(?= MiB)' "$out/log")"
    awk -v t="$threads" -v n="$pictures" -v ms="$ms" -v mib="$mib" -v g="$gflop" \
      'BEGIN { printf "| %d | %d | %.1f | %.0f | %d |\n", t, n, ms, 1000 * g / ms, mib }'
  done
done
