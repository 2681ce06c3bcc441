#!/usr/bin/env bash
# Checks time and memory over a long run: a recording in TUM layout, played forward and backward up to
# FRAMES frames. Prints milliseconds per stage, of all frames and of each quarter, and the memory.
# usage: benchmarks/long_run.sh RECORDING [FRAMES=10000] [FLAGS FOR mms run]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
recording="$(realpath "$1")"
frames="${2:-10000}"
shift $(($# > 2 ? 2 : $#))
long="$out/long"
mkdir "$long"
for part in "$recording"/*; do
  case "${part##*/}" in
    rgb.txt | depth.txt | groundtruth*.txt) ;;
    *) ln -s "$part" "$long/" ;;
  esac
done

# Pairs images at most 0.02 s apart and lists them alternately forward and backward.
awk -v frames="$frames" -v folder="$long" '
  function gap(a, b) { return rgb[a] > rgb[b] ? rgb[a] - rgb[b] : rgb[b] - rgb[a] }
  /^#/ { next }
  FNR == NR { depth[++depths] = $1; depth_file[depths] = $2; next }
  {
    while (at < depths && depth[at + 1] <= $1) at++
    near = at < depths && (at == 0 || depth[at + 1] - $1 < $1 - depth[at]) ? at + 1 : at
    off = depth[near] - $1
    if (off > 0.02 || off < -0.02) next
    rgb[++pairs] = $1; rgb_file[pairs] = $2; delay[pairs] = off; with[pairs] = depth_file[near]
  }
  END {
    if (pairs < 2) { print "less than two pairs of images" > "/dev/stderr"; exit 1 }
    time = 1000; k = 1; step = 1
    for (i = 0; i < frames; ++i) {
      printf "%.6f %s\n", time, rgb_file[k] > (folder "/rgb.txt")
      printf "%.6f %s\n", time + step * delay[k], with[k] > (folder "/depth.txt")
      if (k + step < 1 || k + step > pairs) step = -step
      time += gap(k, k + step); k += step
    }
  }' "$recording/depth.txt" "$recording/rgb.txt"

quietly "$mms" run "$long" -o "$out/run" "$@"

echo "| stage | mean | p50 | p99 | mean of each quarter |"
echo "| --- | --- | --- | --- | --- |"
for stage in read segmentation fusion features odometry mapping; do
  column="$(head -1 "$out/run/timing.csv" | tr ',' '\n' | grep -n "^$stage$" | cut -d : -f 1)"
  tail -n +2 "$out/run/timing.csv" | cut -d , -f "$column" > "$out/column"
  sort -g "$out/column" > "$out/sorted"
  awk -v stage="$stage" '
    FNR == NR { sorted[FNR] = $1; n = FNR; next }
    { sum[int(4 * (FNR - 1) / n)] += $1 }
    END {
      quarter = n / 4
      printf "| %s | %.1f | %.1f | %.1f | %.1f, %.1f, %.1f, %.1f |\n", stage,
        (sum[0] + sum[1] + sum[2] + sum[3]) / n, sorted[int((n + 1) / 2)], sorted[int(0.99 * n)],
        sum[0] / quarter, sum[1] / quarter, sum[2] / quarter, sum[3] / quarter
    }' "$out/sorted" "$out/column"
done
grep -E "^ +(frames|rate|time per frame|peak memory)" "$out/log"
