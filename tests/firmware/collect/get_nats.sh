#!/bin/sh
# Unpacks Debian 13's nats-server into FOLDER, also on Debian 12, whose own is too old for config/fleet/nats.conf. Nothing is
# installed. Does nothing where it is there already; without a network it says so, and its test says skipped. Usage:
# get_nats.sh FOLDER
set -eu
[ -x "$1/nats-server" ] && exit 0
rm -rf "$1"
mkdir -p "$1/apt/lists/partial" "$1/apt/cache/archives/partial"
folder=$(realpath "$1")
# Debian's archive as this machine knows it: one holds all releases.
archive=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(CODENAME)' "Created-By: Packages" |
  awk '($2 ~ /^(bookworm|trixie)$/ || $3 ~ /^(bookworm|trixie)$/) && !seen++ { print $1 }')
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $archive trixie main" >"$folder/apt/sources.list"
own_apt() {
  apt-get -qq -o "Dir::Etc::sourcelist=$folder/apt/sources.list" -o Dir::Etc::sourceparts=/dev/null \
    -o "Dir::State::lists=$folder/apt/lists" -o "Dir::Cache=$folder/apt/cache" "$@"
}
cd "$folder/apt"
if [ -n "$archive" ] && own_apt update && own_apt download nats-server 2>/dev/null && dpkg-deb -x nats-server_*.deb .; then
  mv usr/sbin/nats-server ../nats-server
else
  echo "No nats-server: Debian 13's could not be downloaded." >&2
fi
rm -rf "$folder/apt"
