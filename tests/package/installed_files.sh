#!/bin/sh
# Installs both components below a folder of its own and compares files and modes with installed_files.txt; looks whether the
# programs find what belongs to them there, and whether they tell where they were built. Usage: installed_files.sh BUILD CMAKE
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
status=0
(umask 022 && for component in traygauge simulator; do
  DESTDIR="$folder/root" "$2" --install "$1" --component $component --strip >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
done)
root=$folder/root
# Until Debian 12, units and rules lie outside of /usr.
[ -d "$root/lib" ] && mv "$root/lib/systemd" "$root/lib/udev" "$root/usr/lib" && rmdir "$root/lib"
(cd "$root" && find . -mindepth 1 -printf '%y %m %P %l\n' | sed 's/ *$//' | LC_ALL=C sort -k 3) >"$folder/found"
sed '/^#/d' "$here/installed_files.txt" >"$folder/expected"
diff -u "$folder/expected" "$folder/found" || { echo "other files or modes than installed_files.txt says"; status=1; }

"$root/usr/bin/traygauge" config check "$root/etc/traygauge/station.toml" >"$folder/said" 2>&1 && status=1
# All of it can be read; what is absent is what only the site knows.
grep -q 'station.toml: lens: ' "$folder/said" || { echo "the station file is not as expected:"; cat "$folder/said"; status=1; }
"$root/usr/libexec/traygauge/programs/traygauge-hub" hub --config "$root/etc/traygauge/station.toml" --check >"$folder/said" 2>&1 ||
  { cat "$folder/said"; status=1; }
# A capture that names no dish needs those that are installed.
cp -r "$root/usr/share/traygauge/demo/mash_and_meatballs" "$folder/capture"
/usr/bin/python3 - "$folder/capture/capture.json" <<'PYTHON'
import json, sys
capture = json.load(open(sys.argv[1]))
capture.pop("dish", None)
capture.pop("dishes", None)
json.dump(capture, open(sys.argv[1], "w"))
PYTHON
"$root/usr/bin/traygauge" measure "$folder/capture" >"$folder/said" 2>&1 || { echo "dishes are not found:"; cat "$folder/said"; status=1; }

for program in "$root"/usr/libexec/traygauge/programs/*; do
  if strings -a "$program" | grep -F -e "$(cd "$here/../.." && pwd)" -e "$(cd "$1" && pwd)"; then
    echo "$program tells where it was built"
    status=1
  fi
done
exit "$status"
