#!/usr/bin/env bash
# Runs the rows of digests.txt that do not depend on the CPU (x86-64 with AVX2), and prints those
# that changed. They were equal with AVX-512, with AVX2 alone and on an emulated Haswell. The
# network's int8 convolutions depend on it: without VNNI, oneDNN adds products in 16 bits with
# saturation.
# usage: tests/golden/golden_test.sh PROGRAM    (built as the preset release by gcc 12)
#
# After an intended change of results, update the reference on a CPU with AVX-512 VNNI:
#   tests/golden/digests.sh PROGRAM ../shared/data > tests/golden/digests.txt
set -euo pipefail
golden="$(dirname "${BASH_SOURCE[0]}")"

rows='crowd-masks|crowd-masks-vision|warehouse_loop-masks|corridor-none|static-none'
rows+='|warehouse_loop-lidar16-none'
diff <(grep -E "^(#|($rows) )" "$golden/digests.txt") \
  <(GOLDEN_ONLY="^($rows)$" "$golden/digests.sh" "${1:?path of the mms program}") ||
  { echo "'<' is tests/golden/digests.txt, '>' is this program"; exit 1; }
