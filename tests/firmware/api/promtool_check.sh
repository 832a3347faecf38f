#!/bin/sh
# Checks the hub's /metrics, after two scans, with Prometheus' own promtool, from PATH or as get_promtool.sh unpacks it into the
# build folder. Usage: promtool_check.sh BUILD_FOLDER CAPTURES. Exit status 77: there is no promtool.
set -eu
promtool=$(command -v promtool || command -v "$1/promtool/promtool") || { echo "skipped: no promtool; run make test"; exit 77; }
folder=$(mktemp -d)
hub=
trap 'kill $hub 2>/dev/null; wait 2>/dev/null; rm -rf "$folder"' EXIT
: >"$folder/hub.log"
"$1/traygauge" hub --socket "$folder/hub" --store "$folder/r.db" --listen 127.0.0.1:0 >"$folder/hub.log" 2>&1 &
hub=$!
until grep -q http "$folder/hub.log"; do
  kill -0 "$hub" || { cat "$folder/hub.log"; exit 1; }
  sleep 0.1
done
"$1/traygauge" station --devices "simulator:$2" --hub "$folder/hub" --keep "$folder/keep" --name demo >/dev/null 2>&1
address=$(sed -n 's/.*\(http[0-9a-z.:/]*[0-9]\).*/\1/p' "$folder/hub.log")
/usr/bin/python3 -c 'import sys, urllib.request; sys.stdout.buffer.write(urllib.request.urlopen(sys.argv[1]).read())' \
  "$address/metrics" >"$folder/metrics"
grep -q '^traygauge_' "$folder/metrics" || { echo "no figures:"; cat "$folder/metrics"; exit 1; }
grep -q '^traygauge_check_median{station="demo"' "$folder/metrics" || { echo "no medians:"; cat "$folder/metrics"; exit 1; }
"$promtool" check metrics <"$folder/metrics"
