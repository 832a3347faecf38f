#!/bin/sh
# Checks the units of config/systemd: systemd understands every line, and shuts the services in as far as it did when this was
# written (0: shut in, 10: free). Usage: units_test.sh BUILD_FOLDER. Exit status 77: systemd is not installed.
set -eu
units=$(cd "$(dirname "$0")/../../config/systemd" && pwd)
build=$(cd "$1" && pwd)
if ! command -v systemd-analyze >/dev/null || ! command -v systemd-sysusers >/dev/null; then
  [ "${CI:-}" = true ] && { echo "no systemd: install the packages of config/packages.txt" >&2; exit 1; }
  echo "skipped: no systemd"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
check() { # NAME MOST_TENTHS
  sed "s#/usr/libexec/traygauge/active/traygauge#$build/traygauge#" "$units/traygauge-$1.service" >"$work/traygauge-$1.service"
  # A unit that it does not understand is also said on standard error, with status 0.
  systemd-analyze verify --man=no "$work/traygauge-$1.service" >"$work/said" 2>&1 && ! grep "traygauge-$1" "$work/said" || {
    cat "$work/said"
    status=1
  }
  systemd-analyze security --offline=yes --threshold="$2" "$work/traygauge-$1.service" >"$work/said" || {
    grep -e '✗' -e Overall "$work/said"
    status=1
  }
}
check station 9
check hub 15
# What the units name exists once these are applied.
systemd-sysusers --dry-run "$units/sysusers.conf" >"$work/users" 2>&1 || { cat "$work/users"; status=1; }
sed -n 's/^User=//p' "$units"/*.service | while read -r user; do
  grep -q "Creating user '$user'" "$work/users" || getent passwd "$user" >/dev/null || {
    echo "sysusers.conf makes no user $user"
    exit 1
  }
done || status=1
exit "$status"
