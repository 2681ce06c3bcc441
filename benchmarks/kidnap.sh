#!/usr/bin/env bash
# Relocalization of a sensor that is carried in the dark, with people over half of its view when the
# light is back, in the simulated warehouse with exact masks.
# usage: benchmarks/kidnap.sh [CASES]   (default: 40)
# Per 20 cases one warehouse. "away": 50 places of another warehouse, with people as close, in the
# map of this one, in which every answer is wrong.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
cases="${1:-40}"
relocalize="$(tool mms_relocalize)"
errors="$(dirname "${BASH_SOURCE[0]}")/kidnap_errors.py"
readonly per_seed=20 away=50

# setting KEY: of the scene.
setting() { "$mms" simulate kidnap --print | sed -n "s/^$1: *\([0-9.]*\).*/\1/p"; }
dark_from="$(setting dark_from)" dark_for="$(setting dark_for)" light_for="$(setting light_for)"
duration="$(awk -v a="$dark_from" -v b="$dark_for" -v c="$light_for" -v n="$per_seed" \
  'BEGIN { print a + n * (b + c) }')"
first="$(awk -v t="$dark_from" 'BEGIN { print 15 * t }')"  # frames until it is dark

echo "| seed | cases | within 1 s | later | wrong | time, median and largest [s] | away |"
echo "| --- | --- | --- | --- | --- | --- | --- |"
for ((seed = 1; per_seed * (seed - 1) < cases; ++seed)); do
  quietly "$mms" simulate kidnap --seed "$seed" --set duration="$duration" -o "$out/rec"
  quietly "$mms" run "$out/rec" --segmenter masks -o "$out/run"
  read -r all fast late wrong times < <("$errors" "$out/rec" "$out/run" "$dark_from" "$dark_for" "$light_for")
  other="sim:warehouse_loop?seed=$((1000 + seed))&companions=3&frames=900"
  away_found="$("$relocalize" "$out/rec" "$first" "$other" 45 "$away" 2> /dev/null || true)"
  echo "| $seed | $all | $fast | $late | $wrong | $times | $away_found |"
  rm -rf "$out/rec" "$out/run"
done
