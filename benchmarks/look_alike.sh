#!/usr/bin/env bash
# Loops to the map of an aisle from two others that look like it, of the simulated scene
# long_aisles with exact masks. Every one of them is wrong.
# usage: benchmarks/look_alike.sh [SEEDS] [SENSOR]   (default: "1 2 3 4 5" and l515)
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
seeds="${1:-1 2 3 4 5}" sensor="${2:-l515}"
readonly straight=360  # frames along an aisle
readonly third=77.2 fourth=115.8  # starts along these aisles [m]

# drive START FLAGS...: the result is in $out/run.
drive() {
  local start="$1"
  shift
  quietly "$mms" run "sim:long_aisles?seed=$seed&sensor=$sensor&frames=$straight&start=$start" \
    --segmenter masks -o "$out/run" --overwrite "$@"
}

echo "| sensor, seed | checked in the third aisle | closed | in the fourth, turned aisle | closed |"
echo "| --- | --- | --- | --- | --- |"
for seed in $seeds; do
  drive 0 --save-map "$out/first.mmsmap"
  row="| $sensor, $seed |"
  for start in $third $fourth; do
    drive "$start" --map "$out/first.mmsmap" --localise
    metrics="$out/run/metrics.json"
    row="$row $(value "$metrics" checked '"loops"') | $(value "$metrics" closed earlier_map) |"
  done
  echo "$row"
  rm -f "$out/first.mmsmap"
done
