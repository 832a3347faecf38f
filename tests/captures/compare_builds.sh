#!/bin/sh
# Largest difference of any volume between two builds, say release and debug, over captures.
# Usage: compare_builds.sh BUILD_A BUILD_B CAPTURE...   (build folders that hold the program `traygauge`)
# RUN_B: what runs the program of BUILD_B, an emulator say. LIMIT_ML: a larger difference is a failure.
set -eu
if [ $# -lt 3 ]; then
  echo "usage: $0 BUILD_A BUILD_B CAPTURE..." >&2
  exit 2
fi
build_a=$1
build_b=$2
shift 2

list_volumes() { # BUILD CAPTURE EMULATOR
  ${3:-} "$1/traygauge" measure "$2" --json --seed 1 | "$(dirname "$0")/../support/item_volumes.sh"
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for capture; do
  list_volumes "$build_a" "$capture" >"$work/a"
  list_volumes "$build_b" "$capture" "${RUN_B:-}" >"$work/b"
  if [ ! -s "$work/a" ] || [ "$(wc -l <"$work/a")" != "$(wc -l <"$work/b")" ]; then
    echo "$capture: the builds measured different items" >&2
    exit 1
  fi
  paste -d ' ' "$work/a" "$work/b" | sed "s|\$| $(basename "$capture")|" >>"$work/all"
done
awk -v limit="${LIMIT_ML:-1e9}" '{ difference = $2 - $4; if (difference < 0) difference = -difference
       printf "%s item %s: %.6f ml and %.6f ml\n", $5, $1, $2, $4
       if (difference > largest) largest = difference }
     END { printf "largest difference: %.6g ml\n", largest; exit largest > limit }' "$work/all"
