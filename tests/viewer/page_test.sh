#!/usr/bin/env bash
# usage: page_test.sh unit|dist|browser WORK_DIR
# Tests of the viewer's page, in a copy of viewer/ in WORK_DIR with the packages of package-lock.json.
# Exits with 77 and the reason where Node, chromium or the packages are not available.
set -euo pipefail
readonly page="$(cd "$(dirname "${BASH_SOURCE[0]}")/../../viewer" && pwd)"
readonly work="$2"

skip() {
  echo "skipped: $*"
  exit 77
}

# Fetches the packages once for all tests, and again when they change.
install_packages() {
  mkdir -p "$work"
  cp "$page/package.json" "$page/package-lock.json" "$page/.npmrc" "$work/"
  if ! cmp -s "$page/package-lock.json" "$work/installed"; then
    rm -rf "$work/node_modules"
    if ! (cd "$work" && npm ci --ignore-scripts --loglevel=error); then
      (cd "$work" && npm view three version > /dev/null 2>&1) || skip "npm cannot fetch packages here"
      exit 1
    fi
    cp "$page/package-lock.json" "$work/installed"
  fi
  rm -rf "$work"/{src,public,test,index.html,tsconfig.json,vite.config.ts}
  cp -r "$page"/{src,public,test,index.html,tsconfig.json,vite.config.ts} "$work/"
}

command -v node > /dev/null || skip "node is not installed"
command -v npm > /dev/null || skip "npm is not installed"
[ "$(node -p 'process.versions.node.split(".")[0]')" -ge 18 ] || skip "node $(node --version) is older than 18"
if [ "$1" = browser ]; then
  export CHROMIUM="${CHROMIUM:-$(command -v chromium || true)}"
  [ -n "$CHROMIUM" ] || skip "chromium is not installed"
fi
install_packages
cd "$work"

case "$1" in
  unit)
    npm run --silent lint
    npm run --silent test
    ;;
  dist)
    rm -rf dist
    npm run --silent build
    diff -r dist "$page/dist" || { echo "viewer/dist differs from the build of viewer/src: run npm ci && npm run build there"; exit 1; }
    [ "$(du -sb dist | cut -f1)" -le 2097152 ] || { echo "viewer/dist is larger than 2 MB"; exit 1; }
    ! grep -rnE '<script>|<style|style="| on[a-z]+="' dist/index.html || { echo "the page's policy forbids inline code"; exit 1; }
    ;;
  browser)
    node --test test/browser/browser_test.mjs
    ;;
esac
