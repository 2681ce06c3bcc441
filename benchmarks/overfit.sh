#!/usr/bin/env bash
# Trains each row of the paper's Table I on 16 images until it overfits; continues an interrupted
# training.
# usage: benchmarks/overfit.sh FOLDER
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
runs="$1"
mkdir -p "$runs"

echo "| network | images | class | AP | AP50 |"
echo "| --- | --- | --- | --- | --- |"
for variant in solov2 solov2+rfp solov2+sac solov2+detectors; do
  sed "s/VARIANT/$variant/" config/train/overfit.yaml > "$runs/$variant.yaml"
  quietly "$mms" train -c "$runs/$variant.yaml" -o "$runs/$variant"
  # The last validation of each class that the set contains.
  awk -F'[:," ]+' -v name="$variant" '
    $2 == "AP" { ap = $3 }
    $2 == "AP50" { ap50 = $3 }
    $2 == "category" { category = $3 }
    $2 == "images" && ap != "null" {
      row[category] = sprintf("%s | %s | %.1f | %.1f", $3, category, 100 * ap, 100 * ap50)
    }
    END { for (c in row) printf "| %s | %s |\n", name, row[c] }' "$runs/$variant/log.json"
done
