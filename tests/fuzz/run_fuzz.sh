#!/bin/sh
# Fuzzes every target, RUNS runs in all, and keeps what it finds in FOLDER/fuzz: a corpus for each target, from which the next
# run goes on, and the inputs that failed. FOLDER is a build with clang. Usage: run_fuzz.sh FOLDER RUNS
# FUZZ_TARGETS='hub_socket message' takes these alone, each with its share of RUNS. FUZZ_JOBS=2 fuzzes two targets at a time.
# FUZZ_KEEP=12 afterwards chooses so many inputs of each corpus anew as seeds, beside those that people wrote: those that
# reach the most code that the others do not.
set -eu
programs=$1/tests/fuzz
work=$1/fuzz
runs=$2
seeds=$(dirname "$0")/seeds
# On a disk the store's syncs would take nearly all of the time.
if [ -d /dev/shm ]; then export TMPDIR=/dev/shm; fi
# Percent of the runs, and the longest input in bytes: targets that write files or use sockets are slow. Those that take
# longest come first, so that several at a time end together.
targets='scan_document 25 1500
hub_socket 3 1500
station_socket 4 300
message 30 600
journal 2 1200
web_request 18 600
network_file 10 2500
station_file 8 1200'

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

fuzz_target() {
  mkdir -p "$work/$1"
  count=$((runs / 100 * $2))
  "$programs/$1_fuzz" -runs=$count -max_len="$3" -timeout=20 -artifact_prefix="$work/failed/$1-" \
    -print_final_stats=1 -verbosity=0 "$work/$1" "$seeds/$1" >"$work/$1.log" 2>&1 || {
    tail -n 40 "$work/$1.log" >&2
    return 1
  }
  executed=$(sed -n 's/^stat::number_of_executed_units: *//p' "$work/$1.log")
  speed=$(sed -n 's/^stat::average_exec_per_sec: *//p' "$work/$1.log")
  echo "$(date +%T) $1: $executed runs, $speed a second"
  if [ -n "${FUZZ_KEEP:-}" ]; then choose_seeds "$1" "$3"; fi
}

# One line of the list of targets, as xargs starts it below.
if [ $# -eq 5 ]; then
  fuzz_target "$3" "$4" "$5"
  exit
fi

mkdir -p "$work/failed"
for name in ${FUZZ_TARGETS:-}; do
  echo "$targets" | grep -q "^$name " || { echo "No target $name." >&2; exit 2; }
done
echo "$targets" | while read -r name percent longest; do
  case " ${FUZZ_TARGETS:-$name} " in *" $name "*) echo "$name $percent $longest" ;; esac
done | xargs -P "${FUZZ_JOBS:-1}" -L 1 "$0" "$1" "$runs"
