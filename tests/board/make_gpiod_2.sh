#!/bin/bash
# Unpacks libgpiod 2 from bookworm-backports into FOLDER: make_gpiod_2.sh FOLDER. Debian 12 itself has version 1; the board tests
# are run with both. Does nothing when it is there.
set -euo pipefail

folder=$1
[ -e "$folder/done" ] && exit 0
mkdir -p "$folder"
folder=$(realpath "$folder")
# Debian's archive as this machine knows it; its backports lie beside it.
archive=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(CODENAME)' "Created-By: Packages" |
  awk '($2 == "bookworm" || $3 == "bookworm") && !seen++ { print $1 }')
[ -n "$archive" ] || { echo "make_gpiod_2.sh: apt's sources name no archive of Debian 12 (bookworm); add one" >&2; exit 1; }
. "$(dirname "$0")/own_apt.sh" "$folder" "Dir::Etc::sourcelist \"$folder/apt/sources.list\"; Dir::Etc::sourceparts \"/dev/null\";"
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $archive bookworm-backports main" >"$apt/sources.list"
apt-get -qq update
(cd "$folder" && apt-get -qq download libgpiod-dev libgpiod3)
for package in "$folder"/*.deb; do dpkg-deb -x "$package" "$folder"; done
rm -rf "$apt"
touch "$folder/done"
