#!/bin/sh
# Builds and tests this checkout in a Debian 13 (trixie) of its own, which make_root.sh makes: test_debian13.sh FOLDER [COMMAND...]
# With COMMAND, runs that in it instead. There, /checkout is this checkout and /captures TRAYGAUGE_CAPTURES, both read-only; the
# build stays in /build, FOLDER/root/build. JOBS: how many at a time; OPTIONS: further options of cmake.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
checkout=$(cd "$here/../.." && pwd)
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null 2>&1 || { echo "test_debian13.sh: to change its root it needs to be root, and there is no sudo" >&2; exit 1; }
  exec sudo -E "$0" "$@"
fi
# Mounts of its own, and processes: they go when this script does, however it ends.
if [ -z "${TRAYGAUGE_UNSHARED:-}" ]; then
  TRAYGAUGE_UNSHARED=1 exec unshare --mount --pid --fork --kill-child "$0" "$@"
fi
# There is no browser in it, and no page beside the program: their test says skipped.
unset TRAYGAUGE_UNSHARED CI

mkdir -p "$1"
folder=$(realpath "$1")
shift
root=$folder/root
"$here/make_root.sh" "$folder" "$checkout/config/packages.txt"

mkdir -p "$root/checkout" "$root/captures" "$root/build"
mount_read_only() {
  mount --bind "$1" "$2"
  mount -o remount,bind,ro "$2"
}
mount_read_only "$checkout" "$root/checkout"
captures=
if [ -d "${TRAYGAUGE_CAPTURES:-}" ]; then
  mount_read_only "$TRAYGAUGE_CAPTURES" "$root/captures"
  captures=/captures
fi
mount -t proc proc "$root/proc"
mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts"
mount -t tmpfs tmpfs "$root/dev/shm"
mount -t tmpfs tmpfs "$root/tmp"
cp /etc/resolv.conf "$root/etc/resolv.conf" 2>/dev/null || true

jobs=${JOBS:-$(nproc)}
if [ $# = 0 ]; then
  set -- sh -euc "
    cmake --preset release -S /checkout -B /build ${OPTIONS:-}
    cmake --build /build -j $jobs
    ctest --test-dir /build --output-on-failure --no-tests=error -j $jobs -LE '^bench\$'"
fi
[ -n "$captures" ] && export TRAYGAUGE_CAPTURES=$captures || unset TRAYGAUGE_CAPTURES
# Not exec: as the first process of its own it would not be ended by signals.
cd /
chroot "$root" env HOME=/tmp PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 "$@"
