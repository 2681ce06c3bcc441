#!/usr/bin/env bash
# Loop closure in four simulated aisles that look alike, with people and vehicles and exact masks.
# usage: benchmarks/long_aisles.sh [SEEDS] [SENSOR]   (default: "1 2" and l515)
# "revisits", "known places": of loop_recall.py, found and existing. "wrong": accepted loops more
# than 0.3 m or 3 degrees off. "CPU": time that loop closure adds, over its keyframes.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
here="$(dirname "${BASH_SOURCE[0]}")"
seeds="${1:-1 2}" sensor="${2:-l515}"

echo "| sensor, seed | path [m] | keyframes | revisits | known places | loops | wrong |" \
  "error, median and largest [cm], [deg] | ATE [cm] | corrected [cm] | CPU [ms/keyframe] |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
for seed in $seeds; do
  quietly "$mms" simulate long_aisles --sensor "$sensor" --seed "$seed" -o "$out/rec"
  off="$(cpu_of "$mms" run "$out/rec" --segmenter masks --loops off -o "$out/off")"
  on="$(cpu_of "$mms" run "$out/rec" --segmenter masks -o "$out/on")"
  truth="$out/rec/groundtruth.txt" loops_csv="$out/on/loops.csv"
  keyframes="$(value "$out/on/metrics.json" keyframes '"loops"')"
  "$mms" eval trajectory "$truth" "$out/on/trajectory_map.tum" --json > "$out/ate"
  read -r loops wrong error < <("$here/loop_errors.py" "$truth" "$loops_csv")
  read -r path revisits found places near < <("$here/loop_recall.py" "$truth" "$loops_csv")
  echo "| $sensor, $seed | $path | $keyframes | $found of $revisits | $near of $places | $loops |" \
    "$wrong | $error | $(cm "$out/off/metrics.json" ate_rmse_m) | $(cm "$out/ate" ate_rmse_m) |" \
    "$(awk -v a="$off" -v b="$on" -v n="$keyframes" 'BEGIN { printf "%.0f", 1000 * (b - a) / n }') |"
  rm -rf "$out/rec" "$out/off" "$out/on"
done
