#!/bin/sh
# Makes another version of a package, to upgrade to: remake.sh DEB VERSION OUT COMMAND. COMMAND is what sh does in its unpacked
# root before it is packed again.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
dpkg-deb --raw-extract "$1" "$folder/root"
sed -i "s/^Version: .*/Version: $2/" "$folder/root/DEBIAN/control"
rm -f "$folder/root/DEBIAN/md5sums"
(cd "$folder/root" && sh -euc "$4")
dpkg-deb --root-owner-group -Znone --build "$folder/root" "$3" >/dev/null
