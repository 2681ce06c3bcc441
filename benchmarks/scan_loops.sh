#!/usr/bin/env bash
# Loop closure of LiDAR scans in the simulated warehouse, with exact masks: 1.5 laps at 10 Hz.
# usage: benchmarks/scan_loops.sh [SEEDS] [SENSORS]   (default: "1 2 3" and "lidar16 lidar64 livox")
# "wrong": accepted loops more than 0.3 m or 3 degrees off. "away": loops to the map of another
# warehouse, in which every one is wrong. "CPU": time that loop closure adds, over its keyframes.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
errors="$(dirname "${BASH_SOURCE[0]}")/loop_errors.py"
seeds="${1:-1 2 3}" sensors="${2:-lidar16 lidar64 livox}"

echo "| sensor, seed | keyframes | loops | wrong | error, median and largest [cm], [deg] |" \
  "ATE off [cm] | ATE on [cm] | away | CPU [ms/keyframe] |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"
for sensor in $sensors; do
  quietly "$mms" simulate warehouse_loop --sensor "$sensor" --hz 10 --seed 1000 --frames 300 -o "$out/other"
  quietly "$mms" run "$out/other" --segmenter masks -o "$out/run" --save-map "$out/other.mmsmap"
  rm -rf "$out/other" "$out/run"
  for seed in $seeds; do
    quietly "$mms" simulate warehouse_loop --sensor "$sensor" --hz 10 --seed "$seed" --frames 960 -o "$out/rec"
    off="$(cpu_of "$mms" run "$out/rec" --segmenter masks --loops off -o "$out/off")"
    on="$(cpu_of "$mms" run "$out/rec" --segmenter masks -o "$out/on")"
    quietly "$mms" run "$out/rec" --segmenter masks -o "$out/away" --map "$out/other.mmsmap" --localise
    metrics="$out/on/metrics.json"
    keyframes="$(value "$metrics" keyframes '"loops"')"
    "$mms" eval trajectory "$out/rec/groundtruth.txt" "$out/on/trajectory_map.tum" --json > "$out/ate"
    read -r loops wrong error < <("$errors" "$out/rec/groundtruth.txt" "$out/on/loops.csv")
    echo "| $sensor, $seed | $keyframes | $loops | $wrong | $error |" \
      "$(cm "$out/off/metrics.json" ate_rmse_m) | $(cm "$out/ate" ate_rmse_m) |" \
      "$(value "$out/away/metrics.json" closed earlier_map) |" \
      "$(awk -v a="$off" -v b="$on" -v n="$keyframes" 'BEGIN { printf "%.0f", 1000 * (b - a) / n }') |"
    rm -rf "$out/rec" "$out/off" "$out/on" "$out/away"
  done
done
