#!/bin/bash
# Unpacks libgpiod 2 from bookworm-backports into FOLDER: make_gpiod_2.sh FOLDER. Debian 12 itself has version 1; the board tests
# are run with both. Does nothing when it is there.
set -euo pipefail

folder=$1
[ -e "$folder/done" ] && exit 0
mkdir -p "$folder/apt/lists/partial" "$folder/apt/cache/archives/partial"
folder=$(realpath "$folder")
apt=$folder/apt
: >"$apt/status"
mirror=$(apt-get indextargets --format '$(REPO_URI)' "Created-By: Packages" | grep -v security | sed -n 1p)
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] ${mirror:-http://deb.debian.org/debian} bookworm-backports main" \
  >"$apt/sources.list"
cat >"$apt/apt.conf" <<END
APT::Sandbox::User "root";
Dir::State "$apt";
Dir::State::status "$apt/status";
Dir::Cache "$apt/cache";
Dir::Etc::sourcelist "$apt/sources.list";
Dir::Etc::sourceparts "/dev/null";
Debug::NoLocking "true";
END
export APT_CONFIG=$apt/apt.conf LC_ALL=C
apt-get -qq update
(cd "$folder" && apt-get -qq download libgpiod-dev libgpiod3)
for package in "$folder"/*.deb; do dpkg-deb -x "$package" "$folder"; done
rm -rf "$apt"
touch "$folder/done"
