#!/usr/bin/env bash
# Builds the Debian packages in build/demo/packages, checks them with lintian, and installs and uses
# them in a clean Debian 12: the program and its files, and the examples against libmms-dev.
# usage (as root): packaging/check_packages.sh [--readme demo|test] [--old-cpu] [MIRROR...]
#   --readme demo|test  instead: run README's ./demo.sh or ./test.sh on the tracked files in a clean
#                       Debian 12, which shows that no step of the installation is missing
#   --old-cpu           instead: build for x86-64-v2 and run it on an emulated CPU of that level
#   MIRROR              of Debian; left out: mmdebstrap's own
# Needs mmdebstrap and lintian; --old-cpu needs qemu-user-static alone.
# shellcheck disable=SC2016  # commands for the root are expanded there
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
task=packages
case "${1:-}" in
  --readme) task="readme_${2:?demo or test}"; shift 2 ;;
  --old-cpu) task=old_cpu; shift ;;
esac
readonly task mirrors=("$@")
work="$(mktemp -d)"
trap 'rm -rf --one-file-system "$work"' EXIT
readonly work root="$work/root" packages="$PWD/build/demo/packages"

# quietly COMMAND...: shows the output of a failed command alone.
quietly() { "$@" > "$work/log" 2>&1 || { cat "$work/log" >&2; return 1; }; }

say() { printf '== %s\n' "$*"; }

make_root() {
  say "a clean Debian 12"
  mmdebstrap --quiet --mode=root --variant=apt --dpkgopt=force-unsafe-io \
    bookworm "$root" ${mirrors[@]+"${mirrors[@]}"}
  echo "127.0.0.1 localhost" > "$root/etc/hosts"  # as Debian's installer writes it
}

# in_root COMMAND: by bash in the root; what it mounts and starts ends with it.
in_root() {
  unshare --mount --pid --fork --kill-child bash -euc '
    mount -t proc proc "$1/proc"
    mount --rbind /dev "$1/dev"
    exec chroot "$1" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
      DEBIAN_FRONTEND=noninteractive bash -euxo pipefail -c "$2"' _ "$root" "$1"
}

check_packages() {
  say "build"
  quietly cmake --preset demo -DMMS_WITH_PYTHON=ON
  quietly cmake --build build/demo --parallel "$(nproc)" --target all
  rm -rf "$packages"
  quietly cpack --config build/demo/CPackConfig.cmake -B "$packages"
  say "lintian"
  # The changelog closes no bug of Debian's, where this is not uploaded to.
  lintian --fail-on error,warning --allow-root --suppress-tags initial-upload-closes-no-bugs \
    "$packages"/*.deb
  make_root
  cp "$packages"/*.deb "$root/tmp"
  cp -r examples "$root/tmp"
  say "the program"
  in_root 'cd /tmp
    apt-get -qq update
    apt-get -qq install --no-install-recommends ./mms-slam_*.deb > apt.log 2>&1 ||
      { cat apt.log; exit 1; }
    mms doctor
    mms run sim:warehouse_loop --frames 100 > run.log || { cat run.log; exit 1; }
    test "$(grep -vc "^#" results/latest/trajectory.tum)" -eq 100
    grep -q "</html>" results/latest/report.html
    test -s results/latest/static_map.ply
    zgrep -q "^\.SS mms run" /usr/share/man/man1/mms.1.gz
    test -s /usr/share/bash-completion/completions/mms
    test -s /usr/share/zsh/vendor-completions/_mms
    test -s /usr/share/mms/config/default.yaml'
  say "the library"
  in_root 'cd /tmp
    apt-get -qq install --no-install-recommends g++ make cmake ./libmms-dev_*.deb > apt.log 2>&1 ||
      { cat apt.log; exit 1; }
    for example in minimal own_camera own_masks; do
      cmake -S examples/$example -B $example -DCMAKE_BUILD_TYPE=Release > cmake.log
      cmake --build $example > cmake.log || { cat cmake.log; exit 1; }
    done
    minimal/minimal "sim:corridor?frames=3&width=320"
    own_camera/own_camera
    own_masks/own_masks'
  say "the Python module"
  in_root 'cd /tmp
    apt-get -qq install --no-install-recommends ./python3-mms-slam_*.deb > apt.log 2>&1 ||
      { cat apt.log; exit 1; }
    python3 -c "
import mms_slam
recording = mms_slam.Recording(\"sim:crowd?frames=5&width=320\")
slam = mms_slam.Slam(calibration=recording.calibration, segmenter=\"network\")
assert [slam.process_frame(frame).status for frame in recording][-1] == \"tracking\"
slam.finish()
assert len(slam.static_map()) > 1000"'
}

check_readme() {
  make_root
  mkdir "$root/root/mms-slam"
  git ls-files -z | xargs -0 cp --parents --no-dereference -t "$root/root/mms-slam"
  say "./$1.sh"
  in_root "cd /root/mms-slam; time ./$1.sh"
}

check_old_cpu() {
  say "build"
  quietly cmake --preset demo -B build/demo-v2 -DMMS_ARCH=x86-64-v2
  quietly cmake --build build/demo-v2 --parallel "$(nproc)" --target mms_program
  say "x86-64-v2 on an emulated Nehalem"
  qemu-x86_64-static -cpu Nehalem build/demo-v2/mms run "sim:corridor?frames=3&width=160" \
    --segmenter masks -o "$work/run"
}

case $task in
  packages) check_packages ;;
  old_cpu) check_old_cpu ;;
  readme_demo | readme_test) check_readme "${task#readme_}" ;;
  *) echo "--readme takes demo or test" >&2; exit 2 ;;
esac
say "all checks passed"
