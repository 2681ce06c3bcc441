#!/usr/bin/env bash
# The paper's Table I: the four networks with equal data, schedule and hold-out. Prints one row per
# training and the means; continues an interrupted training.
# usage: benchmarks/table1.sh FOLDER [SEED...]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
runs="$1"
shift
[ $# -gt 0 ] || set -- 1 2 3
holdout=data/simulated-holdout
mkdir -p "$runs"

# mean_loss FILE: mean loss of the last 1,000 images.
mean_loss() { grep '"loss"' "$1" | tail -n 5 | grep -oE '[0-9.]+' |
  awk '{ sum += $1 } END { printf "%.3f", sum / NR }'; }

row() {
  local variant="$1" seed="$2" folder="$runs/$1-$2"
  sed "s/VARIANT/$variant/; s/SEED/$seed/" config/train/table1.yaml > "$folder.yaml"
  quietly "$mms" train -c "$folder.yaml" -o "$folder"
  quietly "$mms" segment "$holdout" --annotations "$holdout/annotations.json" --json-only \
    --weights "$folder/weights.safetensors" -o "$folder/found"
  local ms
  ms="$(grep -oP '[0-9.]+(?= ms/image)' "$out/log")"
  echo "$ms" > "$folder/ms"
  "$mms" eval segmentation "$holdout/annotations.json" "$folder/found/results.json" --json \
    > "$folder/ap.json"
  # In the order of the file: of all classes, of people, of vehicles.
  grep -oP '"AP":\K[0-9.]+' "$folder/ap.json" |
    awk -v name="$variant" -v seed="$seed" -v loss="$(mean_loss "$folder/log.json")" -v ms="$ms" '
      { ap[NR] = 100 * $1 }
      END { printf "| %s | %s | %s | %.1f | %.1f | %.1f | %s |\n", name, seed, loss, ap[1], ap[2],
            ap[3], ms }'
}

echo "| network | seed | loss | AP | AP person | AP agv | ms |"
echo "| --- | --- | --- | --- | --- | --- | --- |"
for seed in "$@"; do
  for variant in solov2 solov2+sac solov2+rfp solov2+detectors; do row "$variant" "$seed"; done
done | tee "$out/rows"
awk -F' *[|] *' '{ n[$2]++; for (i = 4; i <= 8; i++) sum[$2, i] += $i }
  END { for (v in n) printf "| %s | mean of %d | %.3f | %.1f | %.1f | %.1f | %.1f |\n", v, n[v],
    sum[v, 4] / n[v], sum[v, 5] / n[v], sum[v, 6] / n[v], sum[v, 7] / n[v], sum[v, 8] / n[v] }' \
  "$out/rows" | sort
