#!/bin/bash
# Unpacks what cross-building for arm64 needs into FOLDER: make_sysroot.sh FOLDER. Debian's packages of another architecture cannot
# be installed beside this machine's. Made anew when the list names other packages, else does nothing.
set -euo pipefail

folder=$1
# The libraries of config/packages.txt; the compiler and the tools are this machine's.
wanted=$(sed 's/#.*//' "$(dirname "$0")/../../config/packages.txt" | grep -e '-dev$' | grep -vx dpkg-dev)
[ "$(cat "$folder/done" 2>/dev/null || true)" = "$wanted" ] && exit 0
rm -rf "$folder"
mkdir -p "$folder/usr/lib" "$folder/usr/bin" "$folder/usr/sbin"
folder=$(realpath "$folder")
for name in lib bin sbin; do ln -s "usr/$name" "$folder/$name"; done

. "$(dirname "$0")/own_apt.sh" "$folder" \
  'APT::Architecture "arm64"; APT::Architectures { "arm64"; }; APT::Install-Recommends "false";'
echo "sysroot: package lists and packages" >&2
apt-get -qq update
apt-get install -y -qq -d libc6-dev "libstdc++-$(aarch64-linux-gnu-g++ -dumpversion)-dev" $wanted >/dev/null
echo "sysroot: unpacking" >&2
for package in "$apt"/cache/archives/*.deb; do
  dpkg-deb --fsys-tarfile "$package" | tar -x --keep-directory-symlink -C "$folder" --exclude=./usr/share/doc \
    --exclude=./usr/share/man --exclude=./usr/share/locale --exclude=./usr/share/icons --exclude=./usr/share/fonts
done
# Links to absolute paths point into this machine; make them relative.
find "$folder" -type l -lname '/*' | while read -r link; do
  ln -sfn "$(realpath -m --relative-to="$(dirname "$link")" "$folder$(readlink "$link")")" "$link"
done
# What the packages' own scripts would link.
for library in blas lapack; do
  ln -sfn "$library/lib$library.so.3" "$folder/usr/lib/aarch64-linux-gnu/lib$library.so.3"
done
rm -rf "$apt"
echo "$wanted" >"$folder/done"
echo "sysroot: $(du -sh "$folder" | cut -f 1)" >&2
