#!/bin/sh
# Makes a fresh Debian to try packages in: make_base.sh FOLDER RELEASE ARCH. FOLDER/RELEASE-ARCH is it: Debian's base with apt, and on
# this machine's architecture lintian of that release. Does nothing where it is there. Needs to be root, and for another
# architecture emulation.
set -eu

folder=$1
release=$2
arch=$3
name=$release-$arch
[ -f "$folder/$name.done" ] && exit 0
include=
[ "$arch" != "$(dpkg --print-architecture)" ] || include=--include=lintian
# Debian's archive as this machine knows it: one holds all releases.
# shellcheck disable=SC2016 # apt's format
archive=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(CODENAME)' "Created-By: Packages" |
  awk '($2 ~ /^(bookworm|trixie)$/ || $3 ~ /^(bookworm|trixie)$/) && !seen++ { print $1 }')
[ -n "$archive" ] || { echo "make_base.sh: apt's sources name no archive of Debian 12 or 13; add one" >&2; exit 1; }
rm -rf "${folder:?}/$name"
mkdir -p "$folder"
folder=$(realpath "$folder")
# How this machine's apt reaches the archive.
apt-config dump | grep -E '^Acquire::(Check|http|https|Retries)' >"$folder/$name.conf" || true
echo "package test: a fresh $name" >&2
# shellcheck disable=SC2086 # an option or none
mmdebstrap --quiet --mode=root --variant=apt --format=directory --architectures="$arch" $include \
  --aptopt="$folder/$name.conf" --dpkgopt=force-unsafe-io --skip=essential/unlink,cleanup/apt/lists "$release" "$folder/$name" \
  "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $archive $release main" >"$folder/$name.log" 2>&1 ||
  { tail -n 20 "$folder/$name.log" >&2; exit 1; }
touch "$folder/$name.done"
