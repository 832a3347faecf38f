#!/bin/bash
# Runs a script in a guest that make_guest.sh made: run_guest.sh ARCH FOLDER SCRIPT FILE...
# SCRIPT and FILEs as for pack_guest.sh. No network. Exit status: the script's; 124 when it takes longer than BOARD_TIMEOUT_S;
# 125 when the guest ends without one.
set -euo pipefail

arch=$1
folder=$2
shift 2
case $arch in
  amd64) qemu="qemu-system-x86_64 -M q35 -cpu max"; console="ttyS0 no_timer_check" ;;  # a busy host's timer is late
  arm64) qemu="qemu-system-aarch64 -M virt -cpu cortex-a72"; console=ttyAMA0 ;;
esac
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$(dirname "$0")/pack_guest.sh" "$arch" "$folder" "$work/initrd" "$@"

status=0
timeout "${BOARD_TIMEOUT_S:-600}" $qemu -accel tcg,thread=multi -smp 2 -m 2048 -nic none -display none -monitor none -no-reboot \
  -kernel "$folder/vmlinuz" -initrd "$work/initrd" -append "console=$console quiet panic=-1" \
  -serial "file:$work/console" </dev/null || status=$?
tr -d '\r' <"$work/console" | sed '/^GUEST-EXIT/d'
[ "$status" = 124 ] && exit 124
result=$(tr -d '\r' <"$work/console" | sed -n 's/^GUEST-EXIT \([0-9]*\)$/\1/p' | tail -n 1)
exit "${result:-125}"
