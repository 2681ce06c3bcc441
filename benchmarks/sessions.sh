#!/usr/bin/env bash
# Localization in the map of an earlier day, in the simulated warehouse with exact masks: a fifth of
# the rack loads are gone or others, other people are in view, and the start is elsewhere.
# usage: benchmarks/sessions.sh [SEEDS]   (default: "1 2 3")
# Errors are in the frame of the map, without alignment. "away": the same, in the map of another
# warehouse, in which every localization is wrong.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
seeds="${1:-1 2 3}"

# error FILE: ATE rmse of the corrected poses of the second day in the frame of the map [cm].
error() {
  "$mms" eval trajectory "$out/second/groundtruth.txt" "$1/trajectory_map.tum" --no-align --json > "$out/error.json"
  cm "$out/error.json" ate_rmse_m
}

echo "| seed | keyframes | map [MB] | first fix [s] | loops to the map | localize [cm] | map on [cm] | merged sessions | new, gone points | away |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
quietly "$mms" simulate warehouse_loop --seed 1000 --frames 300 -o "$out/other"
quietly "$mms" run "$out/other" --segmenter masks -o "$out/run" --save-map "$out/other.mmsmap"
for seed in $seeds; do
  quietly "$mms" simulate warehouse_loop --seed "$seed" -o "$out/first"
  quietly "$mms" run "$out/first" --segmenter masks -o "$out/run" --overwrite --save-map "$out/map.mmsmap"
  rm -rf "$out/first"
  quietly "$mms" simulate second_day --seed "$seed" -o "$out/second"
  quietly "$mms" run "$out/second" --segmenter masks -o "$out/localize" --map "$out/map.mmsmap" --localize
  quietly "$mms" run "$out/second" --segmenter masks -o "$out/extend" --map "$out/map.mmsmap" --save-map "$out/both.mmsmap"
  quietly "$mms" run "$out/second" --segmenter masks -o "$out/away" --map "$out/other.mmsmap" --localize
  quietly "$mms" run "$out/second" --segmenter masks -o "$out/alone" --save-map "$out/alone.mmsmap"
  "$mms" merge "$out/alone.mmsmap" "$out/map.mmsmap" -o "$out/merged.mmsmap" 2> /dev/null > "$out/merged"
  quietly "$mms" map export "$out/both.mmsmap" -o "$out/export"
  metrics="$out/localize/metrics.json"
  echo "| $seed | $(value "$metrics" keyframes earlier_map) | $(du -m "$out/map.mmsmap" | cut -f1)" \
    "| $(value "$metrics" localized_s) | $(value "$metrics" closed earlier_map) | $(error "$out/localize")" \
    "| $(error "$out/extend") | $(sed -n 's/.*: \([0-9]*\) of 2 sessions joined.*/\1/p' "$out/merged")" \
    "| $(sed -n 's/.*changes.ply: \(.*\)$/\1/p' "$out/log") | $(value "$out/away/metrics.json" closed earlier_map) |"
  rm -rf "$out/second" "$out/localize" "$out/extend" "$out/away" "$out/alone" "$out/export" "$out"/*.mmsmap.partial \
    "$out/both.mmsmap" "$out/alone.mmsmap" "$out/merged.mmsmap" "$out/map.mmsmap"
done
