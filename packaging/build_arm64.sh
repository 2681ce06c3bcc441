#!/usr/bin/env bash
# Cross-compiles the mms program and its tests for 64-bit ARM (Jetson, Raspberry Pi 5) into
# build/arm64, and with --test runs tests and short runs in an emulator, where the results are
# compared with those of an x86-64 program.
# usage (as root): packaging/build_arm64.sh --sysroot FOLDER [--test PROGRAM] [MIRROR...]
#   --sysroot FOLDER  Debian 12 for arm64, outside of the repository; made where it is missing
#   --test PROGRAM    the mms program for this machine to compare with
#   MIRROR            of Debian; left out: mmdebstrap's own
# Needs mmdebstrap, crossbuild-essential-arm64 and qemu-user-static.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source .ci/setup.sh

[ "${1:-}" = --sysroot ] || { sed -n '2,/^set/{/^#/p}' "$0" >&2; exit 2; }
sysroot="$(realpath -m "$2")"
shift 2
reference=""
if [ "${1:-}" = --test ]; then
  reference="$(realpath "$2")"
  shift 2
fi
export MMS_SYSROOT="$sysroot"
readonly modules=(core geometry localization fusion mapping pipeline)

# The libraries for arm64, without running anything of that architecture.
make_sysroot() {
  local packages
  packages="$(packages_of demo | grep -vE '^(g\+\+|cmake|ninja-build)$' | paste -sd,)"
  mmdebstrap --mode=root --variant=extract --architectures=arm64 \
    --include="$packages,libgtest-dev,libstb-dev,libblas-dev,liblapack-dev,libc6-dev" \
    bookworm "$sysroot" "$@"
  # Absolute links would lead to this machine's own libraries.
  find "$sysroot" -type l -lname '/*' -printf '%p %l\n' | while read -r link target; do
    ln -sfrn "$sysroot$target" "$link"
  done
  local libraries="$sysroot/usr/lib/aarch64-linux-gnu" name
  # Ceres names LAPACK by its absolute path.
  sed -i "s#/usr/lib/aarch64-linux-gnu/lib#$libraries/lib#g" \
    "$libraries/cmake/Ceres/CeresTargets.cmake"
  # What update-alternatives does on an installed system.
  for name in blas lapack; do
    ln -sf "$name/lib$name.so" "$name/lib$name.so.3" "$libraries"
  done
}

arm64() { qemu-aarch64-static -L "$sysroot" "$@"; }

# compare NAME OPTIONS...: a run of both programs on the same recording. Simulated scenes themselves
# differ by roundings.
compare() {
  local name="$1" folder=build/arm64/compared
  shift
  rm -rf "$folder"
  "$reference" simulate corridor --frames 5 --set width=320 -o "$folder/recording" > build/arm64/log
  arm64 build/arm64/mms run "$folder/recording" -o "$folder/arm64" "$@" > build/arm64/log
  "$reference" run "$folder/recording" -o "$folder/x86" "$@" > build/arm64/log
  python3 packaging/compare_runs.py "$name" "$folder/arm64" "$folder/x86"
}

[ -d "$sysroot/usr" ] || make_sysroot "$@"
cmake --preset arm64
cmake --build --preset arm64 --parallel "$(nproc)"
[ -n "$reference" ] || exit 0
for module in "${modules[@]}"; do
  arm64 "build/arm64/tests/${module}_test" --gtest_brief=1
done
compare masks --segmenter masks
compare none --segmenter none
compare network --frames 2  # a minute per frame
