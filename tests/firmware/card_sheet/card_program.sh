#!/bin/sh
# Checks that `traygauge card` and `traygauge verify bodies` start the program that makes what is printed, with its exit
# status, and that no other program as it ships loads cairo. Usage: card_program.sh BUILD_FOLDER
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$1/traygauge" card --pattern 2 --out "$folder" >"$folder/out"
grep -q 'TG-02' "$folder/out" || { echo "the id is not told:"; cat "$folder/out"; exit 1; }
[ -s "$folder/card.pdf" ] && [ -s "$folder/card.png" ] || { echo "a file is missing"; ls "$folder"; exit 1; }
"$1/traygauge" card --help | grep -q 'traygauge card \[OPTIONS\]' || { echo "no help"; exit 1; }
"$1/traygauge" --help | grep -q '^  card ' || { echo "traygauge --help does not list it"; exit 1; }

for wrong in '--pattern 0' '--pattern x' '--paper a3' '--measured 83x52.4' '--out /proc/none' '--nonsense' 'word' \
  '--measured 85.6x53.98 --pattern 2'; do
  status=0
  # shellcheck disable=SC2086  # several arguments
  "$1/traygauge" card $wrong >"$folder/out" 2>"$folder/error" || status=$?
  [ "$status" = 2 ] || { echo "card $wrong: exit status $status"; exit 1; }
  [ ! -s "$folder/out" ] || { echo "card $wrong: output"; exit 1; }
  [ "$(wc -l <"$folder/error")" = 1 ] || { echo "card $wrong: not one line"; cat "$folder/error"; exit 1; }
  grep -q '^traygauge: ' "$folder/error" || { echo "card $wrong:"; cat "$folder/error"; exit 1; }
done

"$1/traygauge" verify bodies -o "$folder/bodies.pdf" >"$folder/out"
grep -q R180 "$folder/out" && [ -s "$folder/bodies.pdf" ] || { echo "verify bodies:"; cat "$folder/out"; exit 1; }

ldd "$1/traygauge-card" | grep -q libcairo || { echo "traygauge-card does not load cairo: this test sees nothing"; exit 1; }
for program in traygauge traygauge-station traygauge-hub; do
  if ldd "$1/$program" | grep libcairo; then
    echo "$program loads cairo"
    exit 1
  fi
done
