#!/bin/sh
# Food on photographs of real trays is found about as well as tests/evaluation/labels.md says. Usage:
# tray_photographs_test.sh PROGRAM, which is real_food_on_trays. Exit status 77: there are no captures, which CI counts as a failure.
set -eu
least_iou=0.50 # 0.523 was measured
folder="${TRAYGAUGE_CAPTURES:-}/real/trays_unipd"
if [ ! -d "$folder" ]; then
  echo "no photographs in $folder"
  [ "${CI:-}" != true ] || exit 1
  exit 77
fi
figures=$("$1" "$folder") # a crash ends the test, whatever was printed before it
echo "$figures"
echo "$figures" | awk -v least="$least_iou" '
  $1 == "mean" { mean = $2 }
  END { if (!(mean >= least)) { print "expected a mean IoU of " least " at least, found " mean; exit 1 } }'
