#!/usr/bin/env bash
# Installs what is missing, builds, checks the format and runs all tests.
# The last line counts them: "N passed, N failed, N skipped".
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source .ci/setup.sh

readonly report="$PWD/build/release/tests.xml"

# count NAME: of the attributes at the head of the tests' report.
count() {
  grep -m1 -oP "^\s*$1=\"\K[0-9]+" "$report"
}

install_packages demo tests training python ros
install_packages docs || echo "going on without the API reference"
install_test_tools
if ! build release; then
  echo "0 passed, 1 failed"
  exit 1
fi

rm -f "$report"
failed=0
check_format >&2 || failed=1  # one failure, however many files there are
ctest --test-dir build/release -j2 --output-on-failure --output-junit "$report" || true
if [ ! -s "$report" ]; then
  echo "0 passed, 1 failed"
  exit 1
fi

skipped=$(($(count skipped) + $(count disabled)))
passed=$(($(count tests) - $(count failures) - skipped))
failed=$((failed + $(count failures)))
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
