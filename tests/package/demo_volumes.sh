#!/bin/sh
# The station on simulated devices, as it ships, measures the demo's trays as it always does: demo_volumes.sh PROGRAM DEMO VOLUMES.
# DEMO is the folder of the trays, VOLUMES a file of lines "outlines tray label ml". Builds for other processors round differently. With
# outlines that are given, a cell of a height map that goes to the other side moves a volume by up to 0.03 ml, where sigma is 1 to 4 ml:
# at most 0.05 ml. Where outlines are found, a cell at an edge may go to the other side: half a percent.
# RUN is what runs the program, an emulator say.
# TRAYGAUGE_GOLDEN_UPDATE=1 writes VOLUMES anew.
set -eu
program=$1
demo=$2
volumes=$3
measured=$(mktemp)
trap 'rm -f "$measured"' EXIT
for outlines in given auto; do
  scans=$(${RUN:-} "$program" station --devices "simulator:$demo" --scans 2 --labels "$outlines" --json)
  echo "$scans" | while read -r scan; do
    tray=$(echo "$scan" | sed 's/.*"tray":"\([^"]*\)".*/\1/')
    echo "$scan" | "$(dirname "$0")/../support/item_volumes.sh" |
      while read -r label volume_ml; do printf '%s %s %s %.4f\n' "$outlines" "$tray" "$label" "$volume_ml"; done
  done
done >"$measured"
[ -z "${TRAYGAUGE_GOLDEN_UPDATE:-}" ] || cp "$measured" "$volumes"
awk '
  { item = $1 " " $2 " " $3 }
  NR == FNR { expected[item] = $4; left++; next }
  !(item in expected) { print "an item that is not in the file: " $0; wrong = 1; next }
  { left--; off = $4 - expected[item]; limit = $1 == "given" ? 0.05 : 0.005 * expected[item] }
  off > limit || off < -limit { print item ": expected " expected[item] " ml, found " $4; wrong = 1 }
  { print }
  END { if (left != 0) { print left " items were not measured"; wrong = 1 } exit wrong }' "$volumes" "$measured"
