#!/bin/sh
# Reads the package's scripts as sh does, and as shellcheck does where it is installed; each refuses what it does not know.
set -eu
folder=$(cd "$(dirname "$0")/../../config/debian" && pwd)
status=0
for script in preinst postinst prerm postrm; do
  file=$folder/traygauge.$script
  [ -x "$file" ] || { echo "$file cannot be executed"; status=1; }
  sh -n "$file" || status=1
  grep -qx 'set -e' "$file" || { echo "$file goes on after a failure"; status=1; }
  found=0
  "$file" nonsense >/dev/null 2>&1 || found=$?
  # postrm and others fail before they do anything.
  [ "$found" = 1 ] || { echo "$file nonsense: exit status $found"; status=1; }
done
if command -v shellcheck >/dev/null; then
  shellcheck "$folder"/traygauge.* "$(dirname "$0")"/*.sh "$folder/../../simulator/traygauge-demo" || status=1
fi
exit "$status"
