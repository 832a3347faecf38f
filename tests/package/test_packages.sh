#!/bin/sh
# Tries packages in a fresh Debian: test_packages.sh FOLDER RELEASE ARCH PACKAGES. RELEASE is bookworm or trixie, ARCH amd64 or arm64,
# which is emulated, PACKAGES the folder with both packages; FOLDER keeps a fresh system of each (make_base.sh) and what a test left
# in FOLDER/RELEASE-ARCH.tried. Inside, inside.sh does it. Needs to be root, with mounts of its own.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null 2>&1 || { echo "test_packages.sh: to change its root it needs to be root, and there is no sudo" >&2; exit 1; }
  exec sudo -E "$0" "$@"
fi
# Mounts of its own, and processes: they go when this script does, however it ends.
if [ -z "${TRAYGAUGE_UNSHARED:-}" ]; then
  TRAYGAUGE_UNSHARED=1 exec unshare --mount --pid --fork --kill-child "$0" "$@"
fi
release=$2
arch=$3
package=$(ls "$4"/traygauge_*.deb)
simulator=$(ls "$4"/traygauge-simulator_*.deb)
# The kernel starts programs of the other architecture by the emulator as long as these mounts last. Flag F: it is opened now, so
# that it need not be in the new root.
is_emulated=no
if [ "$arch" = arm64 ] && [ "$(dpkg --print-architecture)" != arm64 ]; then
  [ -e /proc/sys/fs/binfmt_misc/register ] || mount -t binfmt_misc binfmt_misc /proc/sys/fs/binfmt_misc
  [ -e /proc/sys/fs/binfmt_misc/qemu-aarch64 ] || cat /usr/lib/binfmt.d/qemu-aarch64.conf >/proc/sys/fs/binfmt_misc/register
  is_emulated=yes
  lintian --fail-on error,warning --allow-root "$package" "$simulator"
fi
"$here/make_base.sh" "$1" "$release" "$arch"
folder=$(realpath "$1")
root=$folder/$release-$arch.tried
rm -rf "$root"
cp -a "$folder/$release-$arch" "$root"
mkdir -p "$root/packages" "$root/support"
cp "$package" "$root/packages/first.deb"
cp "$simulator" "$root/packages/simulator.deb"
cp "$here"/*.sh "$here/demo_volumes.txt" "$root/packages"
cp "$here"/../support/*.sh "$root/support"
cp "$here/../../simulator/demo/fish_and_potatoes/card.png" "$root/packages"

# Later versions: a good one, three that cannot take over, one that dpkg refuses, and one whose hub takes every store.
version=$(dpkg-deb --field "$package" Version)
later() { # NUMBER NAME COMMAND
  "$here/remake.sh" "$package" "9.$1~${version#*~}" "$root/packages/$2.deb" "$3"
}
broken='printf "#!/bin/sh\nexit 3\n"'
programs=usr/libexec/traygauge/programs
later 1 good "echo '# A key that is new.' >>etc/traygauge/station.toml; printf x >>$programs/traygauge"
later 2 no_hub "$broken >$programs/traygauge-hub"
later 3 no_station "$broken >$programs/traygauge-station"
later 4 no_program "$broken >$programs/traygauge"
later 5 refused "mkdir -p usr/share/doc/apt; echo >usr/share/doc/apt/copyright"
later 6 every_store "printf '#!/bin/sh\necho \"\$4: as expected for a hub\"\n' >$programs/traygauge-hub"

mount -t proc proc "$root/proc"
mount -t tmpfs tmpfs "$root/tmp"
mount -t tmpfs tmpfs "$root/run"
mkdir -p "$root/dev/shm"
mount -t tmpfs tmpfs "$root/dev/shm"
cp /etc/resolv.conf "$root/etc/resolv.conf" 2>/dev/null || true
cd /
# Not exec: as the first process of its own it would not be ended by signals.
chroot "$root" env -i HOME=/tmp PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 \
  DEBIAN_FRONTEND=noninteractive RELEASE="$release" IS_EMULATED="$is_emulated" sh /packages/inside.sh
