#!/usr/bin/env bash
# Writes the API reference with doxygen; its first page is docs/architecture.md.
# usage: docs/api.sh [FOLDER]
#   FOLDER  where it goes (default: build/api)
# Exits with 1 on any warning, and with 77 where doxygen is not installed.
set -euo pipefail
folder="$(realpath -m "${1:-build/api}")"
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if ! command -v doxygen > /dev/null; then
  echo "skipped: doxygen is not installed (packages.txt, group [docs])"
  exit 77
fi

# Folders where every symbol has a comment, operators that compare excepted, and a comment of one
# parameter needs those of the others: what programs on the library use most. Elsewhere a name may
# say it all.
readonly public='mms/(core|dataset/source|io|segmentation/segmenters)/'

mkdir -p "$folder"
warnings="$({ cat docs/Doxyfile; echo "OUTPUT_DIRECTORY = $folder"; } | doxygen - 2>&1 |
  awk -v public="$public" '
    !/^  parameter/ { skip = /not documented[.:]$/ && ($0 !~ public || /operator(==|<=>)/) }
    !skip')"
if [ -n "$warnings" ]; then
  echo "$warnings"
  exit 1
fi
echo "$folder/html/index.html"
