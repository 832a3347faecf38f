#!/bin/sh
# Tries `traygauge self-check` with the programs as they ship. Usage: self_check.sh BUILD SOURCE
set -eu
program=$1/traygauge
demo=$2/simulator/demo/fish_and_potatoes
folder=$(mktemp -d)
hub=
trap '[ -z "$hub" ] || kill "$hub"; rm -rf "$folder"' EXIT
status=0
cp "$demo/card.png" "$folder"
cp -r "$2/config/dishes" "$folder"
file=$folder/station.toml
"$(dirname "$0")/../support/write_station.sh" "$file" "$folder"

expect() { # STATUS LINE…
  wanted=$1
  shift
  found=0
  "$program" self-check "$file" "$capture" >"$folder/said" 2>&1 || found=$?
  [ "$found" = "$wanted" ] || { echo "expected status $wanted, found $found"; status=1; }
  for line in "$@"; do
    grep -q -e "^$line" "$folder/said" || { echo "expected '$line', found:"; cat "$folder/said"; status=1; }
  done
}
capture=--capture=$demo
expect 0 'ok    measurement: .* of .* ml' 'ok    configuration: ' 'ok    hub: .*does not exist yet' 'ok    journal: '
# The files as the programs make them.
mkdir "$folder/waiting"
"$1/traygauge-hub" hub --config "$file" >"$folder/hub.log" 2>&1 &
hub=$!
tries=0
until grep -q 'stores results' "$folder/hub.log"; do
  tries=$((tries + 1))
  [ "$tries" -lt 100 ] || { cat "$folder/hub.log"; exit 1; }
  sleep 0.1
done
"$1/traygauge-station" station --devices "simulator:$demo" --scans 1 --hub "$folder/hub" --keep "$folder/waiting" --name kitchen \
  >"$folder/station.log" 2>&1 || { cat "$folder/station.log"; exit 1; }
expect 0 'ok    hub: .*a store of version [0-9]' 'ok    journal: '
kill "$hub"
wait "$hub" || true
hub=

version_at() { # FILE BYTE OCTAL: as a newer program would write it
  # shellcheck disable=SC2059 # the format is a byte
  printf "\\$3" | dd "of=$1" bs=1 "seek=$2" conv=notrunc status=none
}
version_at "$folder/results.db" 62 001
expect 1 'ok    configuration: ' 'FAIL  hub: .*the store has version 25[0-9], this program knows versions up to' 'ok    journal: '
version_at "$folder/results.db" 62 000
version_at "$folder/waiting/waiting" 8 144
expect 1 'ok    hub: ' 'FAIL  journal: .*a newer program wrote this journal'
version_at "$folder/waiting/waiting" 8 001
version_at "$folder/waiting/last_scan" 8 144
expect 1 'ok    hub: ' 'FAIL  journal: .*a newer program wrote this counter'
version_at "$folder/waiting/last_scan" 8 001
sed -i 's/^store = /stor = /' "$file"
expect 1 'ok    measurement: ' 'FAIL  configuration: .*hub.stor'
sed -i 's/^stor = /store = /' "$file"
# A capture whose truth is another one: the programs measure wrongly.
cp -r "$demo" "$folder/capture"
sed -i 's/"volume_ml": *\([0-9]\)/"volume_ml": 9\1/g' "$folder/capture/truth.json"
capture=--capture=$folder/capture
expect 1 'FAIL  measurement: ' 'ok    configuration: '
capture=--capture=$folder/absent
found=0
"$program" self-check "$file" "$capture" >"$folder/said" 2>&1 || found=$?
[ "$found" = 1 ] || { echo "an absent capture: status $found"; cat "$folder/said"; status=1; }
exit "$status"
