#!/usr/bin/env bash
# Speed and memory of a segmentation network: milliseconds a picture of 640x480 (scaling, network,
# NMS and masks; reading left out), achieved GOP/s, and the process's memory after few and many
# pictures, computed by libtorch (mms-torch) and by the engine in float32 and, if the weights were
# quantized, in int8.
# usage: benchmarks/network.sh WEIGHTS [PICTURES...]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
weights="$1"
shift
[ $# -gt 0 ] || set -- 100 1000
gop="$("$mms" info "$weights" | grep -oP '[0-9.]+(?= GFLOP)')"
echo "$gop GOP a picture"

# row NAME THREADS PICTURES COMMAND...: what of the objects counts for mms run is decoded.
row() {
  local name="$1" threads="$2" pictures="$3"
  shift 3
  quietly "$@" segment "sim:crowd?duration=400" --limit "$pictures" --json-only \
    --threads "$threads" --weights "$weights" -c "$out/settings.yaml" -o "$out/found"
  local ms mib
  ms="$(grep -oP '[0-9.]+(?= ms a picture)' "$out/log")"
  mib="$(grep -oP '[0-9]+(?= MiB)' "$out/log")"
  awk -v name="$name" -v t="$threads" -v n="$pictures" -v ms="$ms" -v mib="$mib" -v g="$gop" \
    'BEGIN { printf "| %s | %d | %d | %.1f | %.0f | %d |\n", name, t, n, ms, 1000 * g / ms, mib }'
}

settings() { echo "segmentation: {$1, decoder: {score: 0.3}}" > "$out/settings.yaml"; }

echo "| computed by | threads | pictures | ms a picture | GOP/s | MiB |"
echo "| --- | --- | --- | --- | --- | --- |"
for pictures in "$@"; do
  for threads in 1 2; do
    settings "backend: libtorch"
    [ ! -x "$mms-torch" ] || row libtorch "$threads" "$pictures" "$mms-torch"
    settings "backend: engine, precision: float32"
    row float32 "$threads" "$pictures" "$mms"
    settings "backend: engine, precision: int8"
    ! grep -qa quantization.range "$weights" || row int8 "$threads" "$pictures" "$mms"
  done
done
