#!/bin/sh
# Makes a fresh Debian to try packages in: make_base.sh FOLDER RELEASE. FOLDER/RELEASE is it: Debian's base with apt, and lintian of
# that release. Does nothing where it is there. Needs to be root.
set -eu

folder=$1
release=$2
[ -f "$folder/$release.done" ] && exit 0
# Debian's archive as this machine knows it: one holds all releases.
# shellcheck disable=SC2016 # apt's format
archive=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(CODENAME)' "Created-By: Packages" |
  awk '($2 ~ /^(bookworm|trixie)$/ || $3 ~ /^(bookworm|trixie)$/) && !seen++ { print $1 }')
[ -n "$archive" ] || { echo "make_base.sh: apt's sources name no archive of Debian 12 or 13; add one" >&2; exit 1; }
rm -rf "${folder:?}/$release"
mkdir -p "$folder"
folder=$(realpath "$folder")
# How this machine's apt reaches the archive.
apt-config dump | grep -E '^Acquire::(Check|http|https|Retries)' >"$folder/$release.conf" || true
echo "package test: a fresh $release" >&2
mmdebstrap --quiet --mode=root --variant=apt --format=directory --include=lintian --aptopt="$folder/$release.conf" \
  --dpkgopt=force-unsafe-io --skip=essential/unlink,cleanup/apt/lists "$release" "$folder/$release" \
  "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $archive $release main" >"$folder/$release.log" 2>&1 ||
  { tail -n 20 "$folder/$release.log" >&2; exit 1; }
touch "$folder/$release.done"
