#!/usr/bin/env bash
# Speed and memory of a segmentation network: milliseconds per image of 640x480 (scaling, network, NMS
# and masks, without reading), GOP/s, and the process's memory after few and many images, for libtorch
# (mms-torch) and for the engine in float32 and, with quantized weights, in int8.
# usage: benchmarks/network.sh WEIGHTS [IMAGES...]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
weights="$1"
shift
[ $# -gt 0 ] || set -- 100 1000
gop="$("$mms" info "$weights" | grep -oP '[0-9.]+(?= GFLOP)')"
echo "$gop GOP/image"

# row NAME THREADS IMAGES COMMAND...: decodes the objects that mms run uses.
row() {
  local name="$1" threads="$2" images="$3"
  shift 3
  quietly "$@" segment "sim:crowd?duration=400" --limit "$images" --json-only \
    --threads "$threads" --weights "$weights" -c "$out/settings.yaml" -o "$out/found" --overwrite
  local ms mb
  ms="$(grep -oP '[0-9.]+(?= ms/image)' "$out/log")"
  mb="$(grep -oP '[0-9]+(?= MB)' "$out/log")"
  awk -v name="$name" -v t="$threads" -v n="$images" -v ms="$ms" -v mb="$mb" -v g="$gop" \
    'BEGIN { printf "| %s | %d | %d | %.1f | %.0f | %d |\n", name, t, n, ms, 1000 * g / ms, mb }'
}

settings() { echo "segmentation: {$1, decoder: {score: 0.3}}" > "$out/settings.yaml"; }

echo "| backend | threads | images | ms/image | GOP/s | MB |"
echo "| --- | --- | --- | --- | --- | --- |"
for images in "$@"; do
  for threads in 1 2; do
    settings "backend: libtorch"
    [ ! -x "$mms-torch" ] || row libtorch "$threads" "$images" "$mms-torch"
    settings "backend: engine, precision: float32"
    row float32 "$threads" "$images" "$mms"
    settings "backend: engine, precision: int8"
    ! grep -qa quantization.range "$weights" || row int8 "$threads" "$images" "$mms"
  done
done
