#!/usr/bin/env bash
# Plays VGA color and depth images at 30 Hz by Fast DDS to `mms ros2` over loopback. Prints how many
# of the pairs it processed, whether the poses are those of mms run, and the results that came back.
# usage: benchmarks/ros2.sh [FRAMES=300] [RELIABILITY=reliable]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
frames="${1:-300}"
reliability="${2:-reliable}"
partner="$(dirname "$mms")/tests/fast_dds_partner"
export ROS_LOCALHOST_ONLY=1 ROS_DOMAIN_ID="$((1 + $$ % 100))"

quietly "$mms" convert "sim:warehouse_loop?frames=$frames&width=640" -o "$out/x.mcap"
quietly "$mms" run "$out/x.mcap" --segmenter none -o "$out/run"
"$mms" ros2 --segmenter none --queue "$frames" --frames "$frames" -o "$out/live" \
  > "$out/node" 2>&1 &
node=$!
# The recording has 15 Hz.
if ! quietly "$partner" play "$out/x.mcap" speed 2 reliability "$reliability" receive "$out/received" \
  topics /mms_slam/odometry=nav_msgs/Odometry expect "$frames" timeout 60; then
  kill "$node"
fi
wait "$node"
poses="$(grep -vc '^#' "$out/live/trajectory.tum")"
same=no
cmp -s "$out/live/trajectory.tum" "$out/run/trajectory.tum" && same=yes
echo "| pairs played | processed | poses of mms run | odometry received |"
echo "| --- | --- | --- | --- |"
echo "| $frames | $poses | $same | $(find "$out/received" -name '*.cdr' | wc -l) |"
