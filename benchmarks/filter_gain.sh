#!/usr/bin/env bash
# Every scene and recording with the filter and without it (--segmenter none --fusion none).
# Required: ATE with the filter <= 1.05 x without + 1 mm, and no more frames lost.
# usage: benchmarks/filter_gain.sh [SEEDS] [DATA/rgbd] [FLAGS FOR mms run WITH FILTER]
#   SEEDS   of the scenes, as "1 2 3"
#   SCENES  environment: the scenes; default: all of depth cameras
#   FOLDER  environment: recordings NAME-SEED of the scenes, as benchmarks/false_masks.sh keeps them
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
seeds="${1:-1 2 3}"
data="${2:-}"
shift $(($# < 2 ? $# : 2))
scenes="${SCENES:-warehouse_loop still_walker crowd stop_and_go corridor static fast rack_aisle}"

# run RECORDING FLAGS: ATE [cm] and lost frames.
run() {
  local recording="$1"
  shift
  quietly "$mms" run "$recording" -o "$out/run" --overwrite "$@" || exit 1
  printf '%s %s\n' "$(cm "$out/run/metrics.json" ate_rmse_m)" \
    "$(value "$out/run/metrics.json" lost)"
}

row() {
  local name="$1" seed="$2" recording="$3"
  shift 3
  local without with
  without="$(run "$recording" --segmenter none --fusion none)"
  with="$(run "$recording" "$@")"
  awk -v name="$name" -v seed="$seed" -v without="$without" -v with="$with" 'BEGIN {
    split(without, o, " "); split(with, w, " ")
    held = w[1] <= 1.05 * o[1] + 0.1 && w[2] <= o[2]
    printf "| %s | %s | %.2f | %.2f | %s | %s | %s |\n", name, seed, o[1], w[1], o[2], w[2],
      held ? "yes" : "**no**"
  }'
}

echo "| recording | seed | ATE without [cm] | ATE with [cm] | lost without | lost with | held |"
echo "| --- | --- | --- | --- | --- | --- | --- |"
if [ -n "$data" ]; then
  for name in fr1_xyz_clip desk_crowd lab_crowd; do row "$name" - "$data/$name" "$@"; done
fi
for seed in $seeds; do
  for name in $scenes; do
    recording="${FOLDER:-}/$name-$seed"
    [ -n "${FOLDER:-}" ] && [ -d "$recording" ] || recording="sim:$name?seed=$seed"
    row "$name" "$seed" "$recording" "$@"
  done
done
