#!/usr/bin/env bash
# Effect of faulty masks, compared to exact ones: 30 % dropped, eroded or with missing parts; all of
# them one frame late; and exact ones of every third frame only. Also the filter in a static scene.
# Masks where nobody is: false_masks.sh.
# usage: benchmarks/mask_faults.sh [SEED] [FRAMES]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
seed="${1:-1}"
frames="${2:-0}"
faults=(--set mask_errors.enabled=true --set mask_errors.missed=0.3 --set mask_errors.lost_parts=0.3)
[ "$frames" = 0 ] && length=() || length=(--frames "$frames")

simulate() {
  local scene="$1"
  shift
  rm -rf "$out/scene"
  quietly "$mms" simulate "$scene" --seed "$seed" -o "$out/scene" "${length[@]}" "$@"
}

# Gives every frame the mask of the previous one.
make_late() {
  local before="" name
  mkdir "$out/scene/late"
  while read -r name; do
    cp "$out/scene/masks/${before:-$name}" "$out/scene/late/$name"
    before="$name"
  done < <(find "$out/scene/masks" -name '*.png' -printf '%f\n' | sort)
  rm -r "$out/scene/masks"
  mv "$out/scene/late" "$out/scene/masks"
}

# Keeps the mask of every third frame.
make_rare() { find "$out/scene/masks" -name '*.png' | sort | awk 'NR % 3 != 1' | xargs rm; }

# row SCENE MASKS [FLAGS FOR mms run]
row() {
  local scene="$1" masks="$2"
  shift 2
  [ $# -gt 0 ] || set -- --segmenter masks
  quietly "$mms" run "$out/scene" -o "$out/run" --overwrite "$@"
  local json="$out/run/metrics.json"
  printf '| %s | %s | %.2f | %.1f | %.1f | %.1f | %s |\n' "$scene" "$masks" \
    "$(cm "$json" ate_rmse_m)" "$(value "$json" sa_pct)" "$(value "$json" da_pct)" "$(value "$json" aa_pct)" \
    "$(value "$json" lost)"
}

echo "| scene | masks | ATE rmse [cm] | SA | DA | AA | lost |"
echo "| --- | --- | --- | --- | --- | --- | --- |"
for scene in warehouse_loop crowd stop_and_go; do
  simulate "$scene"
  row "$scene" exact
  make_rare
  row "$scene" "exact, one frame in three"
  simulate "$scene" "${faults[@]}"
  row "$scene" "dropped and eroded"
  make_late
  row "$scene" "the same, a frame late"
done
simulate static
row static "network" --segmenter network
row static "no filter" --segmenter none --fusion none
