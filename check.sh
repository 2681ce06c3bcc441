#!/usr/bin/env bash
# Checks the sources: format, clang-tidy, architecture, documents. Builds what a check needs.
# usage: ./check.sh [CHECK...] [--since REVISION | --all]
#   CHECK             format, tidy, architecture or docs (default: all four)
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

checks=()
since=HEAD
all=
while [ $# -gt 0 ]; do
  case "$1" in
    format | tidy | architecture | docs) checks+=("$1") ;;
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
