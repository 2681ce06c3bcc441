#!/usr/bin/env bash
# A robot without light for 1.5 s in an aisle that it sees for the first time: errors of the sessions
# before and after, in the simulated warehouse with exact masks.
# usage: benchmarks/dark_sessions.sh [SEEDS]   (default: "1 2 3")
# "in map": frames of the second session with a place in the map, which the end of the lap joins.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
errors="$(dirname "${BASH_SOURCE[0]}")/session_errors.py"
readonly scene="sim:warehouse_loop?dark_from=8&dark_for=1.5&duration=80" frames=1200

echo "| seed | session | frames | in map | rmse [cm] | largest [cm] | loops |"
echo "| --- | --- | --- | --- | --- | --- | --- |"
for seed in ${1:-1 2 3}; do
  quietly "$mms" simulate "$scene" --seed "$seed" --frames "$frames" -o "$out/rec"
  quietly "$mms" run "$out/rec" --segmenter masks -o "$out/run"
  loops="$(grep -c ',accepted,' "$out/run/loops.csv" || true)"
  while read -r session count in_map rmse largest; do
    echo "| $seed | $session | $count | $in_map | $rmse | $largest | $loops |"
  done < <("$errors" "$out/rec" "$out/run")
  rm -rf "$out/rec" "$out/run"
done
