#!/bin/bash
# Puts a script and programs into the memory of a guest that make_guest.sh made: pack_guest.sh ARCH FOLDER INITRD SCRIPT FILE...
# FILEs (programs come with the shared libraries that they need; SYSROOT names where those of another architecture are) lie in
# the guest's /test, where SCRIPT runs.
set -euo pipefail

arch=$1
folder=$2
initrd=$3
script=$4
shift 4
case $arch in
  amd64) triplet=x86_64-linux-gnu ;;
  arm64) triplet=aarch64-linux-gnu ;;
esac
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/root/test"

# The file of the library called $1.
find_library() {
  local place
  for place in lib/$triplet usr/lib/$triplet usr/lib/$triplet/blas usr/lib/$triplet/lapack lib lib64; do
    [ -e "${SYSROOT:-}/$place/$1" ] && { echo "${SYSROOT:-}/$place/$1"; return; }
  done
  echo "pack_guest.sh: no $1 below ${SYSROOT:-/}" >&2
  return 1
}
# Copies what the program or library $1 needs.
add_libraries() {
  local name file
  { readelf -d "$1" 2>/dev/null || true; } | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | while read -r name; do
    [ -e "$work/root/usr/lib/$triplet/$name" ] && continue
    file=$(find_library "$name")
    mkdir -p "$work/root/usr/lib/$triplet"
    cp -L "$file" "$work/root/usr/lib/$triplet/$name"
    add_libraries "$file"
  done
}
for file; do
  cp -a "$file" "$work/root/test/"
  [ -d "$file" ] || add_libraries "$file"
done
cp "$script" "$work/root/test/run.sh"
cp "$(dirname "$0")"/{devices,lines}.sh "$work/root/test/"
env | sed -n 's/^\(BOARD_[A-Z_]*=[0-9]*\)$/export \1/p' >"$work/root/test/environment"
loader=$(for file; do { readelf -l "$file" 2>/dev/null || true; } | sed -n 's/.*interpreter: \(.*\)\]/\1/p'; done | sort -u)
if [ -n "$loader" ]; then
  mkdir -p "$work/root$(dirname "$loader")"
  cp -L "${SYSROOT:-}$loader" "$work/root$loader"
fi
mkdir -p "$work/root/lib"
[ -e "$work/root/lib/$triplet" ] || ln -s "/usr/lib/$triplet" "$work/root/lib/$triplet"
(cd "$work/root" && find . | cpio -o -H newc --quiet) >"$work/test.cpio"
cat "$folder/base.cpio" "$work/test.cpio" >"$initrd"
