#!/bin/sh
# Makes a Debian 13 (trixie) to chroot into, with the packages of the lists named: make_root.sh FOLDER LIST...
# FOLDER/root is it; FOLDER/debs keeps what was downloaded. Made anew when the lists name other packages, else does nothing.
# Needs to be root, and the packages of packages.txt beside this script.
set -eu

folder=$1
shift
root=$folder/root
wanted=$(cat "$@" | sed 's/#.*//' | xargs -n 1 | sort -u | paste -sd ,)
[ "$(cat "$folder/root.done" 2>/dev/null || true)" = "$wanted" ] && exit 0

# Debian's archive as this machine knows it: one holds all releases.
archive=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(CODENAME)' "Created-By: Packages" |
  awk '($2 ~ /^(bookworm|trixie)$/ || $3 ~ /^(bookworm|trixie)$/) && !seen++ { print $1 }')
[ -n "$archive" ] || { echo "make_root.sh: apt's sources name no archive of Debian 12 or 13; add one" >&2; exit 1; }

rm -rf "$root" "$folder/root.done"
mkdir -p "$folder/debs"
folder=$(realpath "$folder")
root=$folder/root
# How this machine's apt reaches the archive.
apt-config dump | grep -E '^Acquire::(Check|http|https|Retries)' >"$folder/apt.conf" || true

echo "debian13: packages" >&2
# Package lists stay in it, because packages_test reads them. Tests read no documentation.
mmdebstrap --quiet --mode=root --variant=apt --format=directory --include="$wanted" --aptopt="$folder/apt.conf" \
  --dpkgopt=force-unsafe-io --dpkgopt='path-exclude=/usr/share/doc/*' --dpkgopt='path-exclude=/usr/share/man/*' \
  --dpkgopt='path-exclude=/usr/share/locale/*' \
  --skip=essential/unlink,cleanup/apt/lists \
  --setup-hook='mkdir -p "$1/var/cache/apt/archives"' \
  --setup-hook="sync-in '$folder/debs' /var/cache/apt/archives" \
  --customize-hook="sync-out /var/cache/apt/archives '$folder/debs'" \
  trixie "$root" "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $archive trixie main" >"$folder/root.log" 2>&1 ||
  { tail -n 20 "$folder/root.log" >&2; exit 1; }
rm -rf "$folder/debs/lock" "$folder/debs/partial" "$folder/apt.conf"
echo "$wanted" >"$folder/root.done"
echo "debian13: $(du -sh "$root" | cut -f 1)" >&2
