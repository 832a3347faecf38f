#!/bin/bash
# Makes a guest for the board tests: make_guest.sh amd64|arm64 FOLDER
# Debian's own kernel, a base of busybox and modules: FOLDER/vmlinuz, FOLDER/base.cpio. The kernel's gpio-sim is not among
# Debian's modules; it is built from Debian's kernel source. Packages are downloaded, none is installed. Needs the packages
# of tests/board/packages.txt. Does nothing when the guest is there and was made by this very script.
set -euo pipefail

arch=$1
folder=$2
cmp -s "$0" "$folder/made_by" && exit 0
case $arch in
  amd64) triplet=x86_64-linux-gnu ;;
  arm64) triplet=aarch64-linux-gnu ;;
  *) echo "make_guest.sh: expected amd64 or arm64, found $arch" >&2; exit 2 ;;
esac
mkdir -p "$folder/debs"
folder=$(realpath "$folder")
host=$(dpkg --print-architecture)
say() { echo "guest $arch: $*" >&2; }

. "$(dirname "$0")/own_apt.sh" "$folder" "APT::Architecture \"$arch\"; APT::Architectures { \"$arch\"; \"$host\"; };"
say "package lists"
apt-get -qq update

image=$(apt-cache depends "linux-image-$arch:$arch" | sed -n 's/.*Depends: \(linux-image-[^:]*\).*/\1/p' | sed -n 1p)
release=${image#linux-image-}
series=$(echo "$release" | cut -d. -f1,2)
say "kernel $release"
(cd "$folder/debs" && apt-get -qq download "$image:$arch" "linux-headers-$release:$arch" "linux-headers-${release%-*}-common" \
  "linux-kbuild-$series:$host" "linux-source-$series" "busybox-static:$arch")

kernel=$folder/kernel
headers=$folder/headers
dpkg-deb -x "$folder/debs/$image"_*.deb "$kernel"
for name in "linux-headers-$release" "linux-headers-${release%-*}-common" "linux-kbuild-$series"; do
  dpkg-deb -x "$folder/debs/$name"_*.deb "$headers"
done
sed -i "s|include /usr/src/|include $headers/usr/src/|" "$headers/usr/src/linux-headers-$release/Makefile"

say "gpio-sim"
modules=$folder/modules
mkdir -p "$modules"
source=linux-source-$series
dpkg-deb --fsys-tarfile "$folder/debs/$source"_*.deb | tar -xO "./usr/src/$source.tar.xz" |
  tar -xJ -C "$modules" --strip-components=3 "$source/drivers/gpio/gpio-sim.c" "$source/drivers/gpio/gpiolib.h" \
    "$source/kernel/irq/irq_sim.c"
# The interrupt simulator is part of the kernel where it is configured; as a module it misses one exported function.
sed -i 's/irq_to_desc(irqnum)/irq_data_to_desc(irq_get_irq_data(irqnum))/' "$modules/irq_sim.c"
printf '\n#include <linux/module.h>\nMODULE_LICENSE("GPL");\n' >>"$modules/irq_sim.c"
echo 'obj-m := irq_sim.o gpio-sim.o' >"$modules/Kbuild"
cross=
[ "$arch" = "$host" ] || cross="CROSS_COMPILE=$triplet-"
make -s -C "$headers/usr/src/linux-headers-$release" M="$modules" ARCH="${arch/amd64/x86_64}" $cross modules \
  >"$folder/modules.log" 2>&1 || { tail -n 20 "$folder/modules.log" >&2; exit 1; }
mkdir -p "$kernel/lib/modules/$release/updates"
cp "$modules"/*.ko "$kernel/lib/modules/$release/updates/"
depmod -b "$kernel" "$release"

say "base"
base=$folder/base
rm -rf "$base"
mkdir -p "$base"/{bin,dev,proc,sys,tmp,etc}
dpkg-deb --fsys-tarfile "$folder/debs/"busybox-static_*.deb | tar -xO ./bin/busybox >"$base/bin/busybox"
chmod +x "$base/bin/busybox"
for module in configfs gpio-sim vivid uvcvideo usbserial cdc_acm vhci-hcd virtio_pci virtio_blk crc32c_generic ext4; do
  modprobe -d "$kernel" -S "$release" --show-depends "$module" 2>/dev/null | sed -n 's/^insmod \([^ ]*\).*/\1/p'
done | sort -u | while read -r file; do
  to=$base/lib/modules/$release/${file#"$kernel/lib/modules/$release/"}
  mkdir -p "$(dirname "$to")"
  cp "$file" "$to"
done
cp "$kernel/lib/modules/$release"/modules.{order,builtin} "$base/lib/modules/$release/"
depmod -b "$base" "$release" 2>/dev/null
cat >"$base/init" <<'END'
#!/bin/busybox sh
/bin/busybox --install -s /bin
export PATH=/bin HOME=/tmp
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t devtmpfs dev /dev
mkdir -p /dev/pts /dev/shm
mount -t devpts devpts /dev/pts
mount -t tmpfs tmpfs /tmp
echo 3 >/proc/sys/kernel/printk
cd /test
sh run.sh
echo "GUEST-EXIT $?"
poweroff -f
END
chmod +x "$base/init"
cp "$kernel/boot/vmlinuz-$release" "$folder/vmlinuz"
(cd "$base" && find . | cpio -o -H newc --quiet) >"$folder/base.cpio.part"
mv "$folder/base.cpio.part" "$folder/base.cpio"
cp "$0" "$folder/made_by"
rm -rf "$kernel" "$headers" "$modules" "$base" "$folder/debs" "$apt"
say "done"
