#!/usr/bin/env bash
# Runs the real recordings below a folder and prints one row of accuracy and speed for each setting.
# usage: benchmarks/recordings.sh DATA/rgbd [FLAGS FOR mms run]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
data="${1:?folder with fr1_xyz_clip, lab_crowd and desk_crowd}"
shift

row() {
  local name="$1" fusion="$2" masks="$3"
  shift 3
  quietly "$mms" run "$data/$name" --segmenter "$masks" --fusion "$fusion" -o "$out/$name" --overwrite "$@"
  local json="$out/$name/metrics.json"
  printf '| %s | %s | %s | %.2f | %.2f | %.2f | %.1f | %.1f | %.1f | %.0f | %s |\n' "$name" \
    "$masks" "$fusion" \
    "$(cm "$json" ate_rmse_m)" "$(cm "$json" atde_m)" "$(cm "$json" mtde_m)" \
    "$(value "$json" rate_hz)" "$(ms "$json" mean)" \
    "$(ms "$json" p99)" "$(value "$json" peak_memory_mb)" "$(value "$json" lost)"
}

echo "| recording | masks | fusion | ATE rmse [cm] | ATDE [cm] | MTDE [cm] | frames/s | ms/frame | p99 [ms] | MB | lost |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
row fr1_xyz_clip none none "$@"
for fusion in multimodal vision none; do row lab_crowd "$fusion" masks "$@"; done
for fusion in multimodal vision none; do row desk_crowd "$fusion" masks "$@"; done
for name in fr1_xyz_clip lab_crowd desk_crowd; do row "$name" multimodal network "$@"; done
