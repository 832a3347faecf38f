#!/bin/sh
# A hub and a station on simulated devices: prints the page's address, and each tray's volumes as they come.
# Usage: run_demo.sh BUILD_FOLDER; the package's traygauge-demo calls it. DEMO_SCANS=2 ends after two trays, else Ctrl-C does;
# DEMO_LISTEN=127.0.0.1:9000 is another address for the page. Results are stored in a folder that is removed at the end.
set -eu
program=$1/traygauge
folder=$(mktemp -d)
hub=
station=
# Children of a script do not hear Ctrl-C when they run in the background.
end() {
  trap - EXIT INT TERM
  for process in $station $hub; do
    kill "$process" 2>/dev/null || true
    wait "$process" 2>/dev/null || true
  done
  rm -rf "$folder"
}
trap end EXIT
trap 'exit 0' INT TERM

: >"$folder/hub.log"
"$program" hub --socket "$folder/hub" --store "$folder/results.db" --listen "${DEMO_LISTEN:-127.0.0.1:8080}" \
  >"$folder/hub.log" 2>&1 &
hub=$!
until grep -q http "$folder/hub.log"; do
  kill -0 "$hub" 2>/dev/null || {
    cat "$folder/hub.log" >&2
    echo "Another address: DEMO_LISTEN=127.0.0.1:9000 make demo" >&2
    exit 1
  }
  sleep 0.1
done
# A program away from its checkout, and not installed, has no page.
sed -n -e 's/^The page is at \(.*\)\.$/Open in a browser: \1/p' -e '/^No page/p' "$folder/hub.log"

if [ -n "${DEMO_SCANS:-}" ]; then end_after="--scans $DEMO_SCANS"; else end_after=--repeat; fi
# shellcheck disable=SC2086 # an option and its value
"$program" station --devices "simulator:$(dirname "$0")/demo" $end_after --real-time --show-pictures \
  --hub "$folder/hub" --keep "$folder/waiting" --name demo 2>"$folder/station.log" &
station=$!
wait "$station" || {
  status=$?
  station=
  cat "$folder/station.log" >&2
  exit "$status"
}
station=
