#!/usr/bin/env bash
# Parts of the robot in the view of a depth camera (mms_robot_body), which are ignored or not.
# usage: benchmarks/robot_body.sh [SEED] [FRAMES] [DATA/rgbd]
# With DATA it also runs fr1_xyz_clip and desk_crowd.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
seed="${1:-1}"
frames="${2:-200}"
data="${3:-}"
add_robot_body="$(tool mms_robot_body)"

# run RECORDING [FLAGS]: ATE [cm] and lost frames.
run() {
  local recording="$1" segmenter=none
  shift
  [ ! -d "$recording/masks" ] || segmenter=masks
  quietly "$mms" run "$recording" --segmenter "$segmenter" -o "$out/run" --overwrite "$@"
  printf '%.1f, %s' "$(cm "$out/run/metrics.json" ate_rmse_m)" "$(value "$out/run/metrics.json" lost)"
}

# rows NAME RECORDING
rows() {
  local name="$1" recording="$2" shape texture
  for shape in bumper arm frame; do
    for texture in plain checkered; do
      rm -rf "$out/part"
      quietly "$add_robot_body" "$recording" "$out/part" "$shape" "$texture" "$frames"
      echo "| $name | $shape, $texture | $(run "$out/part" --set robot_body.enabled=false) | $(run "$out/part") |"
    done
  done
}

echo "| recording | part of the robot | not ignored: ATE [cm], lost | ignored |"
echo "| --- | --- | --- | --- |"
for scene in warehouse_loop crowd; do
  rm -rf "$out/scene"
  quietly "$mms" simulate "$scene" --seed "$seed" --frames "$frames" -o "$out/scene"
  rows "$scene" "$out/scene"
done
if [ -n "$data" ]; then
  for name in fr1_xyz_clip desk_crowd; do rows "$name" "$data/$name"; done
fi
