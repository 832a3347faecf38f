#!/bin/sh
# Installs the Debian packages of packages.txt (or of the list named) that are missing; does nothing when all are there.
set -eu

list=${1:-$(dirname "$0")/packages.txt}
wanted=$(sed 's/#.*//' "$list")

if ! command -v dpkg-query >/dev/null 2>&1; then
  echo "This is not a Debian-like system; I go on with the tools that are here. What is needed, by Debian's names:" >&2
  echo $wanted >&2
  exit 0
fi

installed=$(dpkg-query -W -f '${db:Status-Abbrev} ${Package}\n' $wanted 2>/dev/null | sed -n 's/^ii *//p' || true)
missing=
for package in $wanted; do
  echo "$installed" | grep -qxF -- "$package" || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" = 0 ]; then
  as_root=
elif command -v sudo >/dev/null 2>&1; then
  as_root=sudo
else
  echo "These packages are missing, and neither are you root nor is there sudo:$missing" >&2
  echo "Have them installed: apt-get install --no-install-recommends$missing" >&2
  exit 1
fi

echo "Installing:$missing" >&2
install() {
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing </dev/null
}
# The lists of a fresh image are empty, those of an old one out of date: fetch them when that helps.
install || { $as_root apt-get update </dev/null && install; }
