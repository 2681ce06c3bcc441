# shellcheck shell=bash
# Sourced by demo.sh and test.sh: install_packages, install_test_tools and build.

# Installs what is missing of packages.txt; asks nothing, and does nothing where all is there.
install_packages() {
  if ! command -v dpkg-query > /dev/null; then
    echo "no dpkg here: the packages named in packages.txt must be installed already"
    return
  fi
  local package missing=()
  while read -r package; do
    if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2> /dev/null)" != installed ]; then
      missing+=("$package")
    fi
  done < <(grep -Ev '^[[:space:]]*(#|$)' packages.txt)
  apt_install "${missing[@]}"
}

# Installs what only tests of the viewer use, where the command is missing: they are skipped where
# it cannot be had.
install_test_tools() {
  local missing=()
  command -v node > /dev/null || missing+=(nodejs)
  command -v npm > /dev/null || missing+=(npm)
  command -v chromium > /dev/null || missing+=(chromium)
  apt_install "${missing[@]}" || echo "going on without ${missing[*]}"
}

# apt_install PACKAGE...: from Debian's archive.
apt_install() {
  [ $# -eq 0 ] && return
  echo "installing $*"
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo > /dev/null || { echo "sudo or root is needed for that" >&2; return 1; }
    as_root=(sudo)
  fi
  # ${as_root[@]+...}: an empty array counts as unset in older shells.
  ${as_root[@]+"${as_root[@]}"} apt-get -qq update || return 1
  ${as_root[@]+"${as_root[@]}"} env DEBIAN_FRONTEND=noninteractive apt-get -qq install \
    --no-install-recommends -o Dpkg::Use-Pty=0 "$@" > /dev/null || return 1
}

# build [TARGET...]: configures and builds the release preset, in build/release.
build() {
  local targets=()
  [ $# -gt 0 ] && targets=(--target "$@")
  cmake --preset release > /dev/null &&
    cmake --build build/release --parallel "$(nproc)" ${targets[@]+"${targets[@]}"}
}
