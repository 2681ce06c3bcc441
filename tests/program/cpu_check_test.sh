#!/usr/bin/env bash
# On a CPU without AVX2 the program ends with one sentence that says so.
# usage: tests/program/cpu_check_test.sh PROGRAM
set -euo pipefail
if ! command -v qemu-x86_64-static > /dev/null; then
  echo "skipped: qemu-user-static is not installed"
  exit 77
fi

status=0
output="$(qemu-x86_64-static -cpu Nehalem "${1:?path of the mms program}" --version 2>&1)" || status=$?
printf '%s\n' "$output"
[ "$status" -eq 1 ]
[ "$(wc -l <<< "$output")" -eq 1 ]
[[ "$output" == "error: "*"x86-64-v3"*"AVX2"*"-DMMS_ARCH=x86-64-v2" ]]
