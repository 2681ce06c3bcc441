#!/usr/bin/env bash
# Kills runs (kill -9) at random instants, recovers each from its journal, and prints the lost time
# between the last recovered frame and the kill, which includes the frame being processed; nothing if
# the kill came after the last frame.
# usage: benchmarks/kill.sh [N=20] [SEED=1] [FLAGS FOR mms run]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
kills="${1:-20}"
RANDOM="${2:-1}"
shift $(($# > 2 ? 2 : $#))

# Seconds since 1970, of now or of a date.
clock() { date -u ${1:+-d "$1"} +%s.%3N; }

total=240
quietly "$mms" simulate warehouse_loop --frames "$total" -o "$out/data"
quietly "$mms" run "$out/data" --segmenter masks -o "$out/whole" "$@"
duration="$(awk -v n="$total" -v hz="$(value "$out/whole/metrics.json" rate_hz)" 'BEGIN { print n / hz }')"

# kill_at SECONDS: prints the row of a run killed that long after its first frame.
kill_at() {
  rm -rf "$out/run"
  "$mms" run "$out/data" --segmenter masks -o "$out/run" --keep-journal "${@:2}" > /dev/null 2>&1 &
  local run=$!
  until [ "$(stat -c %s "$out/run/journal.bin" 2> /dev/null || echo 0)" -gt 1000 ]; do sleep 0.01; done
  sleep "$1"
  kill -9 "$run" 2> /dev/null || true
  local killed journal written frames stamp points prefix=no
  killed="$(clock)"
  wait "$run" 2> /dev/null || true
  journal="$(stat -c %s "$out/run/journal.bin")"
  rm -f "$out/run/trajectory.tum"
  quietly "$mms" convert "$out/run"
  written="$(sed -n 's/.*, written \(.*\)$/\1/p' "$out/log")"
  frames="$(sed -n 's/.*: \([0-9]*\) frames up to.*/\1/p' "$out/log")"
  stamp="$(sed -n 's/.*up to stamp \([0-9.]*\),.*/\1/p' "$out/log")"
  points="$(sed -n 's/.* \([0-9]*\) map points/\1/p' "$out/log")"
  cmp -s -n "$(stat -c %s "$out/run/trajectory.tum")" "$out/run/trajectory.tum" \
    "$out/whole/trajectory.tum" && prefix=yes
  awk -v after="$1" -v frames="$frames" -v total="$total" -v stamp="$stamp" -v points="$points" -v prefix="$prefix" \
    -v mb="$journal" -v lost="$(awk -v k="$killed" -v w="$(clock "$written")" 'BEGIN { print k - w }')" \
    'BEGIN { printf "| %.2f | %d | %.3f | %d | %.1f | %s | %.3f |\n",
             after, frames, stamp, points, mb / 1e6, prefix, frames < total ? lost : 0 }'
}

echo "| killed after [s] | frames | up to stamp [s] | map points | journal [MB] | same poses | lost [s] |"
echo "| --- | --- | --- | --- | --- | --- | --- |"
for ((i = 0; i < kills; ++i)); do
  # Within the first 80 % of the duration of a complete run.
  after="$(awk -v r="$RANDOM" -v d="$duration" 'BEGIN { print 0.8 * d * r / 32768 }')"
  kill_at "$after" "$@" | tee -a "$out/rows"
done
awk -F'|' '{ n += 1; bad += $7 !~ /yes/; if ($8 > worst) worst = $8 }
  END { printf "killed %d times, most lost %.3f s, other poses than those of the whole run: %d times\n",
        n, worst, bad }' "$out/rows"
