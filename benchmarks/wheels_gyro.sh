#!/usr/bin/env bash
# Wheels and a gyroscope where images and scans say too little, and what their faults cost.
# usage: benchmarks/wheels_gyro.sh [SEED] [REGEX]
#   SEED   of the scenes (default: 1)
#   REGEX  only the rows whose name matches
# One row a run: ATE, lost and degenerate frames, warnings about the sensors; after `dark` the error
# of the motion over the five seconds of darkness.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
seed="${1:-1}" only="${2:-.}"
wheels="wheels.enabled=true" imu="imu.enabled=true"

# row NAME SCENE FLAGS...: runs the simulation SCENE.
row() {
  local name="$1" scene="$2" json="$out/run/metrics.json"
  shift 2
  [[ "$name" =~ $only ]] || return 0
  "$mms" run "sim:$scene&seed=$seed" -o "$out/run" --overwrite "$@" > "$out/log" 2>&1 ||
    { cat "$out/log" >&2 && return 1; }
  printf '| %s | %.2f | %s | %s | %s |\n' "$name" "$(cm "$json" ate_rmse_m)" \
    "$(value "$json" lost)" "$(value "$json" degenerate)" \
    "$(grep -oE '(wheels|gyroscope): (left out|stamps|used).*' "$out/log" | head -2 | tr '\n' ' ')"
}

# dark NAME SENSORS: five seconds of darkness at 1 m/s, after five with light.
dark() {
  local name="$1" sensors="$2"
  [[ "$name" =~ $only ]] || return 0
  local scene="sim:static?seed=$seed&frames=150&dark_from=5&dark_for=5$sensors"
  quietly "$mms" simulate "$scene" -o "$out/rec" --overwrite
  quietly "$mms" run "$out/rec" --segmenter none --loops off -o "$out/run" --overwrite
  local file
  for file in "$out/rec/groundtruth.txt" "$out/run/trajectory.tum"; do
    awk '$1 > 4.9 && $1 < 9.95' "$file" > "$out/$(basename "$file").dark"
  done
  "$mms" eval trajectory "$out/groundtruth.txt.dark" "$out/trajectory.tum.dark" --rpe-delta 5 \
    --rpe-unit s > "$out/table"
  echo "| $name |" "$(grep -i rpe "$out/table" | tr '\n' ';')" "| | | |"
}

echo "| row | ATE [cm] | lost | degenerate | warnings |"
echo "| --- | --- | --- | --- | --- |"
for fusion in "--segmenter masks --fusion none" "--segmenter none"; do
  for sensors in "" "&$wheels" "&$imu" "&$wheels&$imu"; do
    # shellcheck disable=SC2086  # several flags
    row "stop_and_go $fusion $sensors" "stop_and_go?frames=600$sensors" $fusion
  done
done
for sensors in "" "&$wheels" "&$imu" "&$wheels&$imu"; do dark "dark $sensors" "$sensors"; done
slip="&$wheels&wheels.slip=0.3&wheels.slip_from=4"
for sensors in "" "&$wheels" "$slip"; do
  row "slip $sensors" "warehouse_loop?frames=150$sensors" --segmenter masks
done
for sensors in "" "&$imu"; do
  row "livox $sensors" "warehouse_loop?sensor=livox&frames=80$sensors" --segmenter masks
  row "turns slow $sensors" "fast?turn_rate=30&frames=200$sensors" --segmenter masks
  row "turns fast $sensors" "fast?turn_rate=90&frames=200$sensors" --segmenter masks
done
for sensor in wheels imu; do
  jitter="$([ "$sensor" = wheels ] && echo 0.03 || echo 0.3)"
  for fault in stuck_from=3 jitter="$jitter" delay=0.02 mounting_error=5; do
    row "fault $sensor.$fault" "warehouse_loop?frames=150&$sensor.enabled=true&$sensor.$fault" \
      --segmenter masks
  done
done
