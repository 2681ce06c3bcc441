#!/usr/bin/env bash
# Loop closure and relocalization in the simulated warehouse, with exact masks.
# usage: benchmarks/loops.sh [SEEDS] [CASES]   (default: "1 2 3" and 100)
# Per seed: 1.5 laps with other people in the second one; ATE with --loops off and on, and errors of
# the maps. Then CASES places of the second lap in the map of the first one, and as many of another
# warehouse, in which every answer is wrong.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
seeds="${1:-1 2 3}" cases="${2:-100}"
relocalize="$(tool mms_relocalize)"
readonly first_lap=930 frames=1440  # of 64 s a lap, at 15 Hz

echo "| seed | frames | loops | ATE off [cm] | ATE on [cm] | SA off | SA on | known | unknown |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"
quietly "$mms" simulate warehouse_loop --seed 1000 --frames 300 -o "$out/other"
for seed in $seeds; do
  quietly "$mms" simulate warehouse_loop --seed "$seed" --frames "$frames" -o "$out/rec"
  for loops in off on; do
    quietly "$mms" run "$out/rec" --segmenter masks --loops "$loops" -o "$out/$loops"
  done
  on="$out/on/metrics.json"
  ate="$(awk -v m="$(sed -n '/"loops"/,$p' "$on" | grep -m1 '"ate_rmse_m"' | grep -oE '[0-9.eE-]+,?$' | tr -d ,)" \
    'BEGIN { print 100 * m }')"
  known="$("$relocalize" "$out/rec" "$first_lap" "$out/rec" "$first_lap" "$cases" || true)"
  unknown="$("$relocalize" "$out/rec" "$first_lap" "$out/other" 0 "$cases" || true)"
  echo "| $seed | $frames | $(value "$on" closed) | $(cm "$out/off/metrics.json" ate_rmse_m) | $ate |" \
    "$(value "$out/off/metrics.json" sa_pct) | $(value "$on" sa_pct) | $known | $unknown |"
  rm -rf "$out/rec" "$out/on" "$out/off"
done
