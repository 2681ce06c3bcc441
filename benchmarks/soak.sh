#!/usr/bin/env bash
# A long run in real time with viewers that come, go and send garbage: memory, open files, threads and
# time per frame of each tenth.
# usage: benchmarks/soak.sh [FRAMES=100000] [SCENE=crowd?hz=30] [FLAGS FOR mms run]
#   SCENE  as "still_walker?width=320&hz=30"
# The acceptance is that memory grows by less than 1 % over the last half, and that open files and
# threads are the same at its begin and end.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
frames="${1:-100000}"
scene="${2:-crowd?hz=30}"
shift $(($# > 2 ? 2 : $#))
port=8473
crowd="$(dirname "$mms")/tests/viewer_crowd"
duration="$(awk -v n="$frames" 'BEGIN { print n / 30 + 10 }')"

case "$scene" in *\?*) scene+="&" ;; *) scene+="?" ;; esac
"$mms" run "sim:${scene}frames=$frames&duration=$duration" --realtime --segmenter none --view "$port" \
  --no-map-truth -o "$out/run" "$@" > "$out/log" 2>&1 &
run=$!
sleep 3
(while kill -0 "$run" 2> /dev/null; do "$crowd" "$port" 8 10; sleep 1; done) > "$out/crowd" 2>&1 &

# sample: seconds, memory [KiB], open files, threads.
sample() {
  local memory threads
  memory="$(sed -n 's/^VmRSS:[^0-9]*\([0-9]*\).*/\1/p' "/proc/$run/status" 2> /dev/null)" || return 1
  threads="$(sed -n 's/^Threads:[^0-9]*\([0-9]*\)/\1/p' "/proc/$run/status" 2> /dev/null)" || return 1
  [ -n "$memory" ] || return 1
  echo "$SECONDS $memory $(find "/proc/$run/fd" -type l 2> /dev/null | wc -l) $threads"
}
while sample >> "$out/samples"; do sleep 2; done
wait "$run" || { grep '^mms: ' "$out/log" >&2; exit 1; }

echo "| tenth of the run | memory [MB] | open files | threads | all stages [ms/frame] |"
echo "| --- | --- | --- | --- | --- |"
for tenth in 1 2 3 4 5 6 7 8 9 10; do
  # The least number of files and threads: without viewers.
  awk -v tenth="$tenth" '
    FILENAME ~ /samples$/ { line[++n] = $0; next }
    { ++rows; columns = split($0, part, ","); total[rows] = part[columns - 1] }  # all stages
    END {
      from = int(n * (tenth - 1) / 10) + 1; to = int(n * tenth / 10)
      for (i = from; i <= to; ++i) {
        split(line[i], value, " "); memory += value[2]
        if (files == "" || value[3] < files) files = value[3]
        if (threads == "" || value[4] < threads) threads = value[4]
      }
      for (i = int(rows * (tenth - 1) / 10) + 1; i <= rows * tenth / 10; ++i) { time += total[i]; ++of }
      printf "| %d | %.1f | %d | %d | %.1f |\n", tenth, memory / (to - from + 1) / 1000, files, threads, time / of
    }' "$out/samples" <(tail -n +2 "$out/run/timing.csv") | tee -a "$out/rows"
done
awk -F'|' '$2 == 6 { from = $3 } $2 == 10 { to = $3 } END {
  growth = 100 * (to / from - 1); printf "memory over the last half: %+.2f %%\n", growth; exit growth >= 1 }' "$out/rows"
