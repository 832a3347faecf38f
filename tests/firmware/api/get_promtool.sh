#!/bin/sh
# Unpacks Debian's promtool (package prometheus) into FOLDER, so that no server is installed. Does nothing where it is there
# already, or in PATH; without a network it says so, and the test of /metrics says skipped. Usage: get_promtool.sh FOLDER
set -eu
if command -v promtool >/dev/null || [ -x "$1/promtool" ]; then exit 0; fi
rm -rf "$1"
mkdir -p "$1/package"
cd "$1/package"
get() { apt-get -qq download prometheus 2>/dev/null && dpkg-deb -x prometheus_*.deb .; }
# The lists of an old image are out of date or empty.
if get || { [ "$(id -u)" = 0 ] && apt-get -qq update && get; }; then
  mv usr/bin/promtool ../promtool
else
  echo "No promtool: the package prometheus could not be downloaded." >&2
fi
rm -rf ../package
