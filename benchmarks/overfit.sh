#!/usr/bin/env bash
# Trains each row of the paper's Table I on 16 images until it knows them by heart.
# usage: benchmarks/overfit.sh FOLDER
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
runs="$1"
mkdir -p "$runs"

echo "| network | images seen | class | AP | AP50 |"
echo "| --- | --- | --- | --- | --- |"
for variant in solov2 solov2+rfp solov2+sac solov2+detectors; do
  sed "s/VARIANT/$variant/" config/train/overfit.yaml > "$runs/$variant.yaml"
  quietly "$mms" train -c "$runs/$variant.yaml" -o "$runs/$variant"
  sed -n 's/.*after \([0-9]*\) images, .*, \(.*\): AP \(.*\), AP50 \(.*\)/| \1 | \2 | \3 | \4 |/p' \
    "$out/log" | tail -n 2 | sed "s/^/| $variant /"
done
