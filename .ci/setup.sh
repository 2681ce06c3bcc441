# shellcheck shell=bash
# Sourced by demo.sh, test.sh and check.sh.

# packages_of [GROUP...]: the packages of these groups of packages.txt, of all groups without one.
packages_of() {
  awk -v groups=" $* " '
    /^[[:space:]]*(#|$)/ { next }
    /^\[.*\]$/ { wanted = groups ~ /^ +$/ || index(groups, " " substr($0, 2, length($0) - 2) " "); next }
    wanted' packages.txt
}

# install_packages [GROUP...]: installs what is missing of these groups; asks nothing, and does
# nothing where everything is there.
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
  done < <(packages_of "$@")
  apt_install ${missing[@]+"${missing[@]}"}
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
  echo "installing $# packages: $*"
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

# build PRESET: configures and builds a preset in build/PRESET, and shows how far it is.
build() {
  cmake --preset "$1" > "${TMPDIR:-/tmp}/mms_configure.log" ||
    { cat "${TMPDIR:-/tmp}/mms_configure.log" >&2; return 1; }
  NINJA_STATUS='[%p, %f of %t, %e s] ' cmake --build --preset "$1" --parallel "$(nproc)"
}

# cpp_files: all C++ files of the repository but those that git ignores, or of its source folders if
# it was downloaded without git; each ending with a zero byte.
cpp_files() {
  local file
  {
    git -c safe.directory='*' ls-files -z --cached --others --exclude-standard '*.cpp' '*.hpp' \
      2> /dev/null ||
      find apps benchmarks examples interfaces mms tests -name '*.[ch]pp' -print0
  } |
    while IFS= read -r -d '' file; do
      [ ! -e "$file" ] || printf '%s\0' "$file"
    done
}

# check_format: whether all C++ files are formatted.
check_format() {
  cpp_files | xargs -0 clang-format --dry-run -Werror
}
