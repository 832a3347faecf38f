#!/bin/sh
# Writes a station file that is complete: write_station.sh FILE FOLDER. Hub, results and what waits lie in FOLDER; card.png lies
# beside the file.
set -eu
cat >"$1" <<TOML
[camera]
device = "serial:A1"
[button]
line = "TRIGGER"
[lens]
width = 1600
height = 1200
fx = 1396.9
fy = 1396.9
cx = 801.9
cy = 597.4
distortion = [-0.095, 0.026, 0.0, 0.0, 0.0]
[card]
pattern = "card.png"
width_mm = 85.60
height_mm = 53.98
thickness_mm = 0.8
[station]
name = "kitchen"
socket = "$2/hub"
folder = "$2/waiting"
[hub]
store = "$2/results.db"
TOML
