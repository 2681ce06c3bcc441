#!/usr/bin/env bash
# Runs the rows of digests.txt that do not depend on AVX-512 (x86-64 with AVX2), and prints those
# that changed. They were equal with AVX-512, with AVX2 alone and on an emulated Haswell. On an EPYC
# of the fourth generation (Zen 4) without AVX-512 the last digits are those of digests_zen4.txt,
# since Embree takes AMD's approximate reciprocals there. A run has to equal one of the two files in
# all rows. The network's int8 convolutions depend on the CPU: without VNNI, oneDNN adds products in
# 16 bits with saturation.
# usage: tests/golden/golden_test.sh PROGRAM    (built as the preset release by gcc 12)
#
# After an intended change of results, update the references, the first one on a CPU with AVX-512
# VNNI, the second one on such an EPYC, or on one with AVX-512 where a library of LD_PRELOAD passes
# "isa=avx2" to rtcNewDevice:
#   tests/golden/digests.sh PROGRAM ../shared/data > tests/golden/digests.txt
#   GOLDEN_ONLY="$ROWS" tests/golden/digests.sh PROGRAM > tests/golden/digests_zen4.txt
set -euo pipefail
golden="$(dirname "${BASH_SOURCE[0]}")"

rows='crowd-masks|crowd-masks-vision|warehouse_loop-masks|corridor-none|static-none'
rows+='|warehouse_loop-lidar16-none'
found="$(GOLDEN_ONLY="^($rows)$" "$golden/digests.sh" "${1:?path of the mms program}")"
for reference in digests_zen4 digests; do
  diff <(grep -E "^(#|($rows) )" "$golden/$reference.txt") <(echo "$found") > /dev/null && exit 0
done
diff <(grep -E "^(#|($rows) )" "$golden/digests.txt") <(echo "$found") ||
  { echo "'<' is tests/golden/digests.txt, '>' is this program"; exit 1; }
