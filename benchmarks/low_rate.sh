#!/usr/bin/env bash
# Fast hand-held motion at low frame rates: every N-th image of real recordings, without masks.
# usage: benchmarks/low_rate.sh RGBD ["RECORDING..."]   (default: "desk_crowd fr1_xyz_clip")
# RGBD is the folder of the recordings.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
every_nth="$(dirname "${BASH_SOURCE[0]}")/every_nth.py"

echo "| recording | first image | images/s | ATE [cm] | lost |"
echo "| --- | --- | --- | --- | --- |"
for recording in ${2:-desk_crowd fr1_xyz_clip}; do
  for part in "1 0" "2 0" "2 1" "3 0" "3 1" "3 2" "4 0" "5 0"; do
    read -r step first <<< "$part"
    rate="$("$every_nth" "$1/$recording" "$out/rec" "$step" "$first")"
    quietly "$mms" run "$out/rec" --segmenter none -o "$out/run"
    echo "| \`$recording\` | $first | $rate | $(cm "$out/run/metrics.json" ate_rmse_m)" \
      "| $(grep -c ,lost, "$out/run/frames.csv" || true) |"
    rm -rf "$out/rec" "$out/run"
  done
done
