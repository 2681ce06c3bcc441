#!/usr/bin/env bash
# Runs readers_test.mjs with the packages of package-lock.json. usage: readers_test.sh MMS WORK_DIR
# Exits with 77 and the reason where Node or the packages are not available.
set -euo pipefail
readonly here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
readonly mms="$(realpath "$1")"
readonly work="$2"

"$here/install.sh" "$work"
exec node "$here/readers_test.mjs" "$mms" "$work/node_modules"
