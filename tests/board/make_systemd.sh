#!/bin/bash
# Makes a guest that systemd boots: make_systemd.sh ARCH GUEST FOLDER
# GUEST is one of make_guest.sh's. FOLDER/vmlinuz, FOLDER/base.cpio: the same kernel and modules, Debian's systemd, udev and what
# they depend on. At boot /test/install.sh installs what is tested, then systemd is process 1 and runs /test/run.sh as a service.
# Packages are downloaded, none is installed. Does nothing when it was made of that guest by this very script.
set -euo pipefail

arch=$1
guest=$2
folder=$3
cmp -s "$0" "$folder/made_by" && [ "$folder/made_by" -nt "$guest/made_by" ] && exit 0
rm -rf "$folder"/{base,debs}
mkdir -p "$folder/debs/partial" "$folder/base/system"
folder=$(realpath "$folder")
. "$(dirname "$0")/own_apt.sh" "$folder" "APT::Architecture \"$arch\"; APT::Architectures { \"$arch\"; };"
echo "guest $arch: systemd" >&2
apt-get -qq update
apt-get -qq --yes --download-only --no-install-recommends -o Dir::Cache::archives="$folder/debs" install systemd udev kmod >&2

system=$folder/base/system
for name in bin sbin lib lib64; do
  mkdir -p "$system/usr/$name"
  ln -s "usr/$name" "$system/$name"
done
for package in "$folder"/debs/*.deb; do
  dpkg-deb --fsys-tarfile "$package" | tar -x -C "$system" --keep-directory-symlink --exclude='./usr/share/doc' \
    --exclude='./usr/share/man' --exclude='./usr/share/locale' --exclude='*/udev/hwdb.d'
done
mkdir -p "$system"/{dev,proc,sys,run,tmp,root,etc/systemd/system/multi-user.target.wants,etc/systemd/system.conf.d}
# An id, or systemd takes it for the first boot and enables whatever there is.
echo 0123456789abcdef0123456789abcdef >"$system/etc/machine-id"
# Nobody logs in, and the kernel's modules for automounts are not there.
for unit in getty.target systemd-logind.service proc-sys-fs-binfmt_misc.automount; do
  ln -s /dev/null "$system/etc/systemd/system/$unit"
done
# What it prints comes between the results.
printf '[Manager]\nShowStatus=error\n' >"$system/etc/systemd/system.conf.d/quiet.conf"
# Station and hub start after its READY=1: by then the board and the station file are there.
cat >"$system/etc/systemd/system/board.service" <<'END'
[Unit]
Description=The board, and who tests it
Before=traygauge-station.service traygauge-hub.service

[Service]
Type=notify
NotifyAccess=all
TimeoutStartSec=infinity
WorkingDirectory=/test
ExecStart=/bin/sh -c 'sh run.sh; echo "GUEST-EXIT $?"; poweroff -f'
StandardOutput=tty
StandardError=inherit
END
ln -s ../board.service "$system/etc/systemd/system/multi-user.target.wants/"
# Services get file systems of their own, which the first one, in which the kernel starts, does not allow.
cat >"$folder/base/init" <<'END'
#!/bin/busybox sh
/bin/busybox --install -s /bin
export PATH=/bin
mount -t proc proc /proc
echo 3 >/proc/sys/kernel/printk
umount /proc
mkdir /disk
mount -t tmpfs -o mode=755 disk /disk
cp -a /system/. /disk
cp -a /usr/lib/. /lib/modules /disk/usr/lib
cp /lib64/* /disk/usr/lib64 2>/dev/null
cp /bin/busybox /disk/usr/bin
cp -a /test /disk
chroot /disk /bin/busybox --install -s /bin 2>/dev/null
chroot /disk /bin/sh -c 'cd /test && export PATH=/sbin:/bin && sh install.sh' || { echo "GUEST-EXIT 125"; poweroff -f; }
exec switch_root /disk /lib/systemd/systemd
END
chmod +x "$folder/base/init"
cp "$guest/vmlinuz" "$folder/vmlinuz"
(cd "$folder/base" && find . | cpio -o -H newc --quiet) >"$folder/systemd.cpio"
cat "$guest/base.cpio" "$folder/systemd.cpio" >"$folder/base.cpio"
cp "$0" "$folder/made_by"
rm -rf "$folder"/{base,debs,systemd.cpio} "$apt"
