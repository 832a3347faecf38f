#!/bin/sh
# Fuzzes every target, RUNS runs in all, and keeps what it finds in FOLDER/fuzz: a corpus for each target, from which the next
# run goes on, and the inputs that failed. FOLDER is a build with clang. Usage: run_fuzz.sh FOLDER RUNS
# FUZZ_KEEP=12 afterwards chooses so many inputs of each corpus anew as seeds, beside those that people wrote: those that
# reach the most code that the others do not.
set -eu
programs=$1/tests/fuzz
work=$1/fuzz
runs=$2
seeds=$(dirname "$0")/seeds
# On a disk the store's syncs would take nearly all of the time.
if [ -d /dev/shm ]; then export TMPDIR=/dev/shm; fi
# Percent of the runs, and the longest input in bytes: targets that write files or use sockets are slow.
targets='web_request 18 600
message 30 600
network_file 10 2500
scan_document 25 1500
station_file 8 1200
journal 2 1200
station_socket 4 300
hub_socket 3 1500'

# libFuzzer writes what it chooses in the order of what it adds.
choose_seeds() {
  chosen=$work/$1.chosen
  rm -rf "$chosen"
  rm -f "$seeds/$1"/found_*
  mkdir "$chosen"
  cp "$seeds/$1"/* "$chosen"
  "$programs/$1_fuzz" -set_cover_merge=1 -max_len="$2" "$chosen" "$work/$1" >"$work/$1.merge.log" 2>&1
  number=0
  ls -tr "$chosen" | grep -xE '[0-9a-f]{40}' | head -n "$FUZZ_KEEP" | while read -r input; do
    number=$((number + 1))
    cp "$chosen/$input" "$seeds/$1/found_$number"
  done
}

mkdir -p "$work/failed"
echo "$targets" | while read -r name percent longest; do
  mkdir -p "$work/$name"
  count=$((runs / 100 * percent))
  echo "$(date +%T) $name: $count runs"
  "$programs/${name}_fuzz" -runs=$count -max_len="$longest" -timeout=20 -artifact_prefix="$work/failed/$name-" \
    -print_final_stats=1 -verbosity=0 "$work/$name" "$seeds/$name" >"$work/$name.log" 2>&1 || {
    tail -n 40 "$work/$name.log" >&2
    exit 1
  }
  grep -E 'number_of_executed_units|average_exec_per_sec' "$work/$name.log"
  if [ -n "${FUZZ_KEEP:-}" ]; then choose_seeds "$name" "$longest"; fi
done
