#!/bin/sh
# The network with which food is found: absent, damaged, or for something else. Usage: food_network.sh BUILD SOURCE
set -u
program=$1/traygauge
capture=$2/simulator/demo/mash_and_meatballs
network=$2/config/network/food.tgn
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export TRAYGAUGE_CONFIG="$folder"
status=0

expect() { # WHAT STATUS PATTERN
  found=0
  "$program" segment "$capture" >"$folder/said" 2>&1 || found=$?
  if [ "$found" != "$2" ] || ! grep -q -e "$3" "$folder/said"; then
    echo "$1: expected status $2 and '$3', found status $found and:"
    cat "$folder/said"
    status=1
  fi
}

# A folder of dishes alone: the network that came with the program serves.
expect "no folder network/" 0 '^items *2'
mkdir "$folder/network"
expect absent 2 'food.tgn: expected a network for food'
head -c 2000 "$network" >"$folder/network/food.tgn"
expect "cut off" 2 'a damaged one'
cp "$capture/view_0.jpg" "$folder/network/food.tgn"
expect foreign 2 'a file of another kind'
cp "$network" "$folder/network/food.tgn"
expect whole 0 '^items *2'
# Away from the folders that come with it, the program says what it lacks, and evaluate does so before it measures.
cp "$program" "$folder/alone"
unset TRAYGAUGE_CONFIG
program=$folder/alone
rm -r "$folder/network"
expect "without its folders" 2 'expected the folder with network/'
found=0
"$program" evaluate "$capture" --labels given --out "$folder/out" >"$folder/said" 2>&1 || found=$?
if [ "$found" != 2 ] || ! grep -q 'expected the folder with plots/' "$folder/said" || [ -e "$folder/out/estimates.csv" ]; then
  echo "evaluate without plots/: status $found and:"
  cat "$folder/said"
  status=1
fi
# Labels that are given need none.
"$program" measure "$capture" --labels given >"$folder/said" 2>&1 || { cat "$folder/said"; status=1; }
exit "$status"
