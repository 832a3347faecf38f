#!/bin/sh
# compare_with_peer.sh counts what a peer says: one that measures one food 10 % too large in one pair and nothing else.
# Usage: compare_with_peer_test.sh PROGRAM
set -eu
capture=${TRAYGAUGE_CAPTURES:-}/plates/c1_soup
if [ ! -f "$capture/truth.json" ]; then
  echo "TRAYGAUGE_CAPTURES names no captures" >&2
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
true_ml=$(tr -d ' \n' <"$capture/truth.json" | tr '{' '\n' | sed -n '/"label":2,/s/.*"volume_ml":\([0-9.]*\).*/\1/p')
cat >"$work/peer" <<END
#!/bin/sh
echo '{"pairs": ['
echo ' {"pair": 0, "items": [{"label": 2, "volume_ml": $(awk "BEGIN { print 1.1 * $true_ml }")}], "ms": {"load": 10.0, "total": 110.0}},'
echo ' {"pair": 1, "items": [], "ms": {"load": 10.0, "total": 60.0}}'
echo ']}'
END
chmod +x "$work/peer"
"$(dirname "$0")/compare_with_peer.sh" "$1" "$work/peer" "$capture" | tee "$work/table"
# Two foods in two pairs: one volume, three refusals.
grep -q '^| c1_soup | 10.00 / +10.00 / +10.0, 75 ms (3) | 10.00 / +10.00 / +10.0, 75 ms (3) | [0-9]' "$work/table"
if "$(dirname "$0")/compare_with_peer.sh" "$1" "$work/none" "$capture" 2>"$work/error"; then exit 1; fi
grep -q "none' is no program" "$work/error"
