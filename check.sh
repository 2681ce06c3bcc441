#!/usr/bin/env bash
# Checks the sources: format, clang-tidy, architecture, documents. Builds what a check needs.
# usage: ./check.sh [CHECK...] [--since REVISION | --all] [--tests REGEX]
#   CHECK             format, tidy, architecture or docs (default: all four), or
#                     asan, ubsan, tsan or valgrind: all tests and fault runs under that tool (hours)
#   --tests REGEX     of these, only tests whose names match, and no fault runs
#   --since REVISION  clang-tidy checks the files that differ from REVISION (default: HEAD)
#   --all             clang-tidy checks all files but those with libtorch, for about half an hour
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source .ci/setup.sh

usage() {
  sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
}

# Sources for clang-tidy. A header is checked with the source of the same name.
tidy_files() {
  local sources
  sources="$(sed -nE "s,^ *\"file\": \"$PWD/((mms|apps)/.*)\".*,\1,p" build/tidy/compile_commands.json)"
  if [ -n "$all" ]; then
    echo "$sources"
  else
    { git diff --name-only "$since"; git ls-files --others --exclude-standard; } |
      sed 's/\.hpp$/.cpp/' | sort -u | grep -xFf - <(echo "$sources")
  fi
}

# clang-tidy cannot read gcc's precompiled headers, joined sources and, in version 14, libtorch's
# headers. So it has a build folder of its own, which is only configured.
check_tidy() {
  local files
  cmake -S . -B build/tidy -G Ninja -DMMS_PRECOMPILED_HEADERS=OFF -DMMS_UNITY_BUILD=OFF \
    -DMMS_WITH_TORCH=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON > /dev/null || return 1
  files="$(tidy_files)" || { echo "no source has changed"; return 0; }
  echo "$files" | xargs -n 1 -P "$(nproc)" clang-tidy -p build/tidy --quiet \
    --warnings-as-errors='*' --extra-arg=-Wno-unknown-warning-option 2>&1 |
    sed -E '/^[0-9]+ warnings? .*generated\.$/d'
}

# The preset that is configured already, else the one that is built fastest.
preset() {
  if [ -f build/release/build.ninja ]; then echo release; else echo dev; fi
}

# build_target TARGET: in the folder of `preset`.
build_target() {
  cmake --preset "$(preset)" > /dev/null && cmake --build "build/$(preset)" --target "$1"
}

check_architecture() {
  build_target architecture_test && "build/$(preset)/tests/architecture_test" --gtest_brief=1
}

check_docs() {
  build_target mms_program && python3 tests/docs/commands_test.py "build/$(preset)/mms" .
}

# run_under PRESET: the tests of a preset, then the fault runs with its program. The golden digests
# and times hold for a release build alone.
run_under() {
  cmake --preset "$1" > /dev/null && cmake --build "build/$1" || return 1
  ctest --test-dir "build/$1" --output-on-failure --timeout 3600 -LE golden \
    ${tests:+-R "$tests"} || return 1
  [ -n "$tests" ] || MMS="$PWD/build/$1/mms" benchmarks/faults.sh 5
}

# Reports end the program, so that the test fails.
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1"
export TSAN_OPTIONS="halt_on_error=1:history_size=7:second_deadlock_stack=1:suppressions=$PWD/tests/support/tsan.txt"
export ASAN_OPTIONS="detect_stack_use_after_return=1"

check_asan() { run_under asan; }
check_ubsan() { run_under ubsan; }
check_tsan() { run_under tsan; }

# Valgrind's CPU has AVX2, which release needs. The program's own tests run it as a child.
check_valgrind() {
  build_target all || return 1
  local test failed=0
  for test in "build/$(preset)"/tests/*_test; do
    case "${test##*/}" in
      architecture_test | program_test | viewer_test) continue ;;
    esac
    echo "${test##*/}"
    valgrind --quiet --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite \
      --suppressions=tests/support/valgrind.txt "$test" --gtest_brief=1 \
      ${tests:+"--gtest_filter=*$tests*"} || failed=1
  done
  return "$failed"
}

checks=()
tests=
since=HEAD
all=
while [ $# -gt 0 ]; do
  case "$1" in
    format | tidy | architecture | docs | asan | ubsan | tsan | valgrind) checks+=("$1") ;;
    --tests) tests="${2:?--tests needs a regular expression}"; shift ;;
    --all) all=yes ;;
    --since) since="${2:?--since needs a revision}"; shift ;;
    *) usage ;;
  esac
  shift
done
[ ${#checks[@]} -gt 0 ] || checks=(format tidy architecture docs)

failed=()
for check in "${checks[@]}"; do
  echo "== $check"
  "check_$check" || failed+=("$check")
done
[ ${#failed[@]} -eq 0 ] || { echo "failed: ${failed[*]}"; exit 1; }
echo "all checks passed: ${checks[*]}"
