#!/usr/bin/env bash
# Installs the packages of package-lock.json. usage: install.sh WORK_DIR
# Exits with 77 and the reason where Node or the packages are not available.
set -euo pipefail
readonly here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
readonly work="$1"

skip() {
  echo "skipped: $*"
  exit 77
}

command -v node > /dev/null || skip "node is not installed"
command -v npm > /dev/null || skip "npm is not installed"
mkdir -p "$work"
exec 9> "$work/lock"
flock 9  # tests may run at the same time
if ! cmp -s "$here/package-lock.json" "$work/installed"; then
  cp "$here/package.json" "$here/package-lock.json" "$here/.npmrc" "$work/"
  (cd "$work" && npm ci --ignore-scripts --loglevel=error) || skip "npm cannot fetch packages here"
  cp "$here/package-lock.json" "$work/installed"
fi
