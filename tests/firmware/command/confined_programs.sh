#!/bin/sh
# Checks that station and hub, as they ship, run under their filter of system calls, that the station holds no socket but Unix
# ones and leaves no core dump, and that the hub holds no device. Usage: confined_programs.sh BUILD_FOLDER CAPTURES
set -eu
folder=$(mktemp -d)
trap 'kill $hub $station 2>/dev/null; wait 2>/dev/null; rm -rf "$folder"' EXIT
hub=
station=
"$1/traygauge" hub --socket "$folder/hub" --store "$folder/r.db" --listen 127.0.0.1:0 >"$folder/hub.log" 2>&1 &
hub=$!
"$1/traygauge" station --devices "simulator:$2" --repeat --real-time --hub "$folder/hub" --keep "$folder/keep" \
  >"$folder/station.log" 2>&1 &
station=$!
tries=0
until grep -q 'Scan 1' "$folder/station.log" && grep -q 'http' "$folder/hub.log"; do
  tries=$((tries + 1))
  [ "$tries" -lt 600 ] || { echo "no scan within a minute:"; cat "$folder/station.log" "$folder/hub.log"; exit 1; }
  sleep 0.1
done

status=0
for process in $hub $station; do
  grep -q '^Seccomp:.2' "/proc/$process/status" || { echo "$(readlink "/proc/$process/exe"): no filter"; status=1; }
done
grep -q 'Max core file size  *0 ' "/proc/$station/limits" || { echo "the station may leave a core dump"; status=1; }
for descriptor in "/proc/$hub/fd/"*; do
  case $(readlink "$descriptor") in
    /dev/null | /dev/pts/* | /dev/tty) ;;
    /dev/*) echo "the hub holds $(readlink "$descriptor")"; status=1 ;;
  esac
done
# The numbers of the station's sockets, sought among those of networks.
for descriptor in "/proc/$station/fd/"*; do
  socket=$(readlink "$descriptor" | sed -n 's/^socket:\[\(.*\)\]$/\1/p')
  [ -n "$socket" ] || continue
  for family in tcp tcp6 udp udp6 raw raw6 packet netlink; do
    [ -r "/proc/$station/net/$family" ] || continue
    if grep -qw "$socket" "/proc/$station/net/$family"; then
      echo "the station holds a socket of $family"
      status=1
    fi
  done
done
exit "$status"
