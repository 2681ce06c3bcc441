#!/usr/bin/env bash
# Rate, time per stage and accuracy of LiDAR scans, map included: the KITTI clip of DATA, and the
# simulated warehouse with 64 and 16 rings, rendered before. Of REPEATS runs the fastest counts; the
# first scan, which only initializes, does not. CPU is user and system time of all threads over the
# whole run, results included.
# usage: benchmarks/lidar.sh DATA [REPEATS=3] [FLAGS FOR mms run]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
data="$(realpath "$1")"
repeats="${2:-3}"
shift $(($# > 2 ? 2 : $#))

# mean_of FOLDER COLUMN: mean of a column of timing.csv without the first scan [ms].
mean_of() {
  awk -F , -v name="$2" '
    NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) column = i; next }
    NR > 2 { sum += $column; ++n }
    END { printf "%.1f", sum / n }' "$1/timing.csv"
}

# row NAME RECORDING FLAGS...
row() {
  local name="$1" recording="$2" best="" interval run
  shift 2
  for run in $(seq "$repeats"); do
    TIMEFORMAT='%U %S'
    { time quietly "$mms" run "$recording" -o "$out/$name$run" "$@"; } 2> "$out/$name$run.time"
    interval="$(mean_of "$out/$name$run" interval)"
    if [ -z "$best" ] || awk "BEGIN { exit !($interval < $(mean_of "$best" interval)) }"; then
      best="$out/$name$run"
    fi
  done
  awk -v name="$name" -v interval="$(mean_of "$best" interval)" \
    -v fusion="$(mean_of "$best" fusion)" -v features="$(mean_of "$best" features)" \
    -v odometry="$(mean_of "$best" odometry)" -v mapping="$(mean_of "$best" mapping)" \
    -v frames="$(($(wc -l < "$best/timing.csv") - 1))" -v ate="$(cm "$best/metrics.json" ate_rmse_m)" \
    -v aa="$(value "$best/metrics.json" aa_pct)" -v da="$(value "$best/metrics.json" da_pct)" \
    -v memory="$(value "$best/metrics.json" peak_memory_mb)" '
    { printf "| %s | %.1f | %.0f | %s | %s | %s | %s | %.2f | %.1f | %.1f | %.0f |\n", name,
        1000 / interval, 1000 * ($1 + $2) / frames, fusion, features, odometry, mapping, ate, aa,
        da, memory }' "$best.time"
}

echo "| recording | rate [Hz] | CPU [ms/scan] | fusion [ms] | features [ms] | odometry [ms] |" \
  "mapping [ms] | ATE [cm] | AA [%] | DA [%] | memory [MB] |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
row kitti00_6scans "$data/lidar/kitti00_6scans" --segmenter none "$@"
for sensor in lidar64 lidar16; do
  quietly "$mms" simulate warehouse_loop --sensor "$sensor" --frames 200 -o "$out/$sensor-scans"
  row "$sensor" "$out/$sensor-scans" --segmenter masks "$@"
  rm -rf "${out:?}/$sensor-scans"
done
