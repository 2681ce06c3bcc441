#!/usr/bin/env bash
# Four robots in the simulated aisles that look alike, with people and vehicles and exact masks: each
# drives a part of the path, and mms merge joins their maps.
# usage: benchmarks/merge_robots.sh [SEEDS]   (default: "1")
# ATE of all keyframes together, aligned by one pose. "equal": whether all files of mms map export
# are the same, byte for byte, for another order of the maps.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
seeds="${1:-1}"
readonly starts=(0 80 160 240)  # along the lane of 335 m [m]
readonly frames=1050            # about 120 m, so that neighbors share 40 m
readonly shift=1000             # between the stamps of two robots, to evaluate them together [s]

# shifted NUMBER FILE: poses of one robot.
shifted() { awk -v by="$(($1 * shift))" '!/^#/ && NF { $1 = sprintf("%.9f", $1 + by); print }' "$2"; }

echo "| seed | keyframes | loops | sessions joined | ATE of each, alone [cm] | joint ATE [cm] | merge, CPU [s] | equal |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- |"
for seed in $seeds; do
  alone="" maps=()
  for robot in 0 1 2 3; do
    recording="$out/robot_$robot"
    quietly "$mms" simulate long_aisles --seed "$seed" --frames "$frames" --set start="${starts[$robot]}" -o "$recording"
    quietly "$mms" run "$recording" --segmenter masks -o "$out/run" --overwrite --save-map "$recording.mmsmap"
    alone="$alone $(cm "$out/run/metrics.json" ate_rmse_m)"
    mv "$recording/groundtruth.txt" "$recording.tum"
    rm -rf "$recording"
    maps+=("$recording.mmsmap")
  done
  seconds="$(cpu_of "$mms" merge "${maps[@]}" -o "$out/a.mmsmap")"
  joined="$(sed -n 's/.*: \([0-9]* of [0-9]*\) sessions joined.*/\1/p' "$out/log")"
  quietly "$mms" merge "${maps[2]}" "${maps[0]}" "${maps[3]}" "${maps[1]}" -o "$out/b.mmsmap"
  for name in a b; do quietly "$mms" map export "$out/$name.mmsmap" -o "$out/export_$name"; done
  equal=no
  diff -r "$out/export_a" "$out/export_b" > /dev/null && equal=yes
  # A session is that robot's whose recording it names.
  : > "$out/truth.tum"
  : > "$out/joint.tum"
  session=0
  while read -r robot; do
    shifted "$robot" "$out/robot_$robot.tum" >> "$out/truth.tum"
    shifted "$robot" "$out/export_a/session_$session.tum" >> "$out/joint.tum"
    session=$((session + 1))
  done < <("$mms" info "$out/a.mmsmap" | grep -oE 'robot_[0-9]' | grep -oE '[0-9]$')
  [ "$session" = 4 ] || { echo "the map has $session of 4 sessions" >&2; exit 1; }
  sort -n -o "$out/truth.tum" "$out/truth.tum"
  sort -n -o "$out/joint.tum" "$out/joint.tum"
  quietly "$mms" eval trajectory "$out/truth.tum" "$out/joint.tum" --json
  cp "$out/log" "$out/ate"
  "$mms" info "$out/a.mmsmap" --json > "$out/info"
  echo "| $seed | $(wc -l < "$out/joint.tum") | $(value "$out/info" loops) | $joined |$alone |" \
    "$(cm "$out/ate" ate_rmse_m) | $seconds | $equal |"
  rm -rf "$out"/export_? "$out"/*.mmsmap "$out"/*.tum
done
