#!/usr/bin/env bash
# Simulates the warehouse scenes with exact and with faulty masks, runs them, and prints one row of
# accuracy each.
# usage: benchmarks/scenes.sh [SEED] [FLAGS FOR mms run]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
seed="${1:-1}"
shift $(($# > 0 ? 1 : 0))

# simulate SCENE MASKS: writes the recording for all fusion modes.
simulate() {
  rm -rf "$out/scene"
  quietly "$mms" simulate "$1" --seed "$seed" -o "$out/scene" \
    --set mask_errors.enabled="$([ "$2" = exact ] && echo false || echo true)"
}

row() {
  local scene="$1" masks="$2" fusion="$3"
  shift 3
  quietly "$mms" run "$out/scene" --segmenter masks --fusion "$fusion" -o "$out/run" --overwrite "$@"
  local json="$out/run/metrics.json" drift="- | -"
  # Drift from the first pose is only defined for a static sensor.
  if [ "$scene" = still_walker ]; then
    drift="$(printf '%.3f | %.3f' "$(cm "$json" atde_m)" "$(cm "$json" mtde_m)")"
  fi
  printf '| %s | %s | %s | %.2f | %s | %.1f | %.1f | %.1f | %s |\n' "$scene" "$masks" \
    "$fusion" "$(cm "$json" ate_rmse_m)" "$drift" "$(value "$json" sa_pct)" "$(value "$json" da_pct)" \
    "$(value "$json" aa_pct)" "$(value "$json" lost)"
}

echo "| scene | masks | fusion | ATE rmse [cm] | ATDE [cm] | MTDE [cm] | SA | DA | AA | lost |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
for scene in warehouse_loop still_walker crowd stop_and_go corridor static fast rack_aisle; do
  simulate "$scene" exact
  row "$scene" exact multimodal "$@"
done
for scene in still_walker crowd stop_and_go; do
  simulate "$scene" imperfect
  for fusion in multimodal vision none; do row "$scene" imperfect "$fusion" "$@"; done
done
