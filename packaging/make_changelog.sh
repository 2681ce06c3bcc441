#!/usr/bin/env bash
# Writes the changelog of the Debian packages.
# usage: packaging/make_changelog.sh OUTPUT.gz VERSION MAINTAINER
set -euo pipefail
date="$(date -R -u -r "$(dirname "${BASH_SOURCE[0]}")/../CHANGELOG.md")"
{
  printf 'mms-slam (%s) unstable; urgency=medium\n\n' "$2"
  printf '  * New version; CHANGELOG.md of the sources lists what changed.\n\n'
  printf ' -- %s  %s\n' "$3" "$date"
} | gzip -9n > "$1"
