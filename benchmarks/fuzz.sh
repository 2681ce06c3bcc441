#!/usr/bin/env bash
# Fuzzes each reader of untrusted input (tests/fuzz) with libFuzzer under the address and undefined
# behavior sanitizers, one after the other, and prints a row each. Inputs that find something are in
# build/fuzz/findings; put them into tests/fuzz/corpus/TARGET when they are fixed. What was learned
# stays in build/fuzz/corpus for the next time.
# A finding is a crash, a sanitizer's report, an exception other than an error message, more than 5 s
# for one input, or an allocation of more than 512 MiB.
# usage: benchmarks/fuzz.sh [SECONDS=60] [TARGET...]      (seconds of each target; default: all)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds="${1:-60}"
shift $(($# > 0 ? 1 : 0))
command -v clang++ > /dev/null || { echo "clang++ is missing (Debian package clang)" >&2; exit 1; }
cmake --preset fuzz > /dev/null
cmake --build --preset fuzz > build/fuzz/build.log || { tail -n 20 build/fuzz/build.log; exit 1; }
fuzz=build/fuzz/tests/mms_fuzz
"$fuzz" --seeds build/fuzz/corpus > /dev/null
mkdir -p build/fuzz/findings
[ $# -gt 0 ] || mapfile -t targets < <("$fuzz" --list)
[ $# -eq 0 ] || targets=("$@")

# statistic NAME: of the last run.
statistic() { sed -n "s/^stat::$1: *//p" build/fuzz/log; }

failed=0
echo "| target | seconds | executions | edges covered | inputs kept | largest memory [MB] | findings |"
echo "| --- | --- | --- | --- | --- | --- | --- |"
for target in "${targets[@]}"; do
  earlier=()
  [ ! -d "tests/fuzz/corpus/$target" ] || earlier=("tests/fuzz/corpus/$target")
  found=0
  MMS_FUZZ_TARGET="$target" "$fuzz" -max_total_time="$seconds" -timeout=5 -malloc_limit_mb=512 \
    -rss_limit_mb=3072 -max_len=65536 -print_final_stats=1 -verbosity=1 \
    -artifact_prefix="build/fuzz/findings/$target-" "build/fuzz/corpus/$target" \
    ${earlier[@]+"${earlier[@]}"} > build/fuzz/log 2>&1 || found=1
  cp build/fuzz/log "build/fuzz/$target.log"
  edges="$(grep -oE 'cov: [0-9]+' build/fuzz/log | tail -n 1 | grep -oE '[0-9]+' || echo 0)"
  echo "| $target | $seconds | $(statistic number_of_executed_units) | $edges |" \
    "$(find "build/fuzz/corpus/$target" -type f | wc -l) | $(statistic peak_rss_mb) | $found |"
  failed=$((failed + found))
done
[ "$failed" -eq 0 ] || { echo "findings: see build/fuzz/findings and build/fuzz/TARGET.log" >&2; exit 1; }
