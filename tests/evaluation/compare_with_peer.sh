#!/bin/sh
# Another program's accuracy and time beside ours: the same pairs of the same captures, one program after the other.
# Usage: compare_with_peer.sh PROGRAM PEER CAPTURE...
# PROGRAM is `traygauge`. PEER is a program, or a folder whose CMakeLists.txt builds one;
# `PEER CAPTURE --clock=cpu [--profile=fast]` prints a line of JSON for each pair with "pair", "items" ("label", "volume_ml")
# and "ms" ("load", "total": ms of CPU, of which reading the files is left out). Foods of a height field are compared with
# their volume_ml. Captures with several dishes are measured by ours alone.
set -eu
if [ $# -lt 3 ]; then
  echo "usage: $0 PROGRAM PEER CAPTURE..." >&2
  exit 2
fi
program=$1
peer=$2
shift 2
seeds=5

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ -d "$peer" ]; then
  if ! { cmake -S "$peer" -B "$work/peer" -DCMAKE_BUILD_TYPE=Release && cmake --build "$work/peer"; } >"$work/log" 2>&1; then
    cat "$work/log" >&2
    exit 1
  fi
  peer=$(find "$work/peer" -maxdepth 1 -type f -perm -u+x | head -n 1)
fi
for file in "$program" "$peer"; do
  if [ ! -f "$file" ] || [ ! -x "$file" ]; then
    echo "$0: '$file' is no program" >&2
    exit 2
  fi
done
for capture; do
  if [ ! -f "$capture/capture.json" ] || [ ! -f "$capture/truth.json" ]; then
    echo "$0: '$capture' is no capture with truth.json" >&2
    exit 2
  fi
done

# What follows collects lines "truth CAPTURE LABEL ML", "volume METHOD CAPTURE LABEL ML" (ML is - when refused) and
# "time METHOD CAPTURE PAIRS MS", of all pairs.

# CPU of ours by the difference between many seeds and one: files are read once.
run_ours() {
  method=$1
  times >"$work/times0"
  "$program" evaluate "$2" --profile "$method" --runs 1 >/dev/null
  times >"$work/times1"
  "$program" evaluate "$2" --profile "$method" --runs "$seeds" --out "$work/out" >/dev/null
  times >"$work/times2"
  awk -F, -v method="$method" -v capture="$3" '
    FNR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    { pairs[$column["first"], $column["second"]] = 1 }
    $column["kind"] == "heightfield" {
      print "truth", capture, $column["label"], $column["truth_ml"]
      print "volume", method, capture, $column["label"], $column["status"] == "ok" ? $column["volume_ml"] : "-"
    }
    END { for (pair in pairs) ++count; print "pairs", count }' "$work/out/estimates.csv" >"$work/lines"
  grep -v '^pairs' "$work/lines"
  cat "$work/times0" "$work/times1" "$work/times2" | tr 'ms' '  ' |
    awk -v method="$method" -v capture="$3" -v seeds="$seeds" -v pairs="$(sed -n 's/^pairs //p' "$work/lines")" '
      NR % 2 == 0 { cpu[NR / 2] = 60 * ($1 + $3) + $2 + $4 }
      END { print "time", method, capture, pairs, 1000 * ((cpu[3] - cpu[2]) - (cpu[2] - cpu[1])) / (seeds - 1) }'
}

run_peer() {
  method=$1
  capture=$2
  name=$3
  shift 3
  "$peer" "$capture" --clock=cpu "$@" | awk -v method="$method" -v capture="$name" '
    function number(text, key) {
      if (!match(text, "\"" key "\": *[-+0-9.eE]+")) return "-"
      text = substr(text, RSTART, RLENGTH)
      sub(/.*: */, "", text)
      return text
    }
    NR == FNR { if ($1 == "truth") labels[$3] = 1; next }
    /"pair":/ {
      ++pairs
      split("", ml)
      if (match($0, /"items": *\[[^]]*\]/)) {
        count = split(substr($0, RSTART, RLENGTH), items, "}")
        for (i = 1; i <= count; ++i)
          if (items[i] ~ /"label"/) ml[number(items[i], "label")] = number(items[i], "volume_ml")
      }
      for (label in labels) print "volume", method, capture, label, label in ml ? ml[label] : "-"
      ms += number($0, "total") - number($0, "load")
    }
    END { print "time", method, capture, pairs, ms }' "$work/lines" -
}

for capture; do
  name=$(basename "$capture")
  run_ours best "$capture" "$name"
  if grep -q '"dishes"' "$capture/capture.json"; then continue; fi
  run_ours paper "$capture" "$name"
  run_peer accurate "$capture" "$name"
  run_peer fast "$capture" "$name" --profile=fast
done >"$work/all"

echo "MAPE / bias / worst in %, CPU of a pair; (n) volumes were refused."
echo
echo "| capture | peer, accurate | peer, fast | best | paper |"
echo "| --- | --- | --- | --- | --- |"
awk '
  function absolute(x) { return x < 0 ? -x : x }
  function is_in(capture, row) { return row == "one dish" ? has_one_dish[capture] : capture == row }
  function cell(method, row,    key, part, items, mape, bias, count, missing, worst, ms, pairs) {
    items = mape = bias = count = missing = worst = ms = pairs = 0
    for (key in tried) {
      split(key, part, SUBSEP)
      if (part[1] != method || !is_in(part[2], row)) continue
      missing += tried[key] - measured[key]
      if (measured[key] == 0) continue
      ++items
      mape += sum[key] / measured[key]
      bias += signed[key]
      count += measured[key]
      if (absolute(largest[key]) > absolute(worst)) worst = largest[key]
    }
    if (items == 0) return missing > 0 ? "(" missing ")" : "–"
    for (key in time_ms) {
      split(key, part, SUBSEP)
      if (part[1] != method || !is_in(part[2], row)) continue
      ms += time_ms[key]
      pairs += time_pairs[key]
    }
    return sprintf("%.2f / %+.2f / %+.1f, %.0f ms%s", mape / items, bias / count, worst, ms / pairs, \
      missing > 0 ? " (" missing ")" : "")
  }
  $1 == "truth" {
    truth[$2, $3] = $4
    if (!($2 in seen)) order[++captures] = $2
    seen[$2] = 1
  }
  $1 == "volume" && ($3, $4) in truth {
    if ($2 != "best") has_one_dish[$3] = 1
    key = $2 SUBSEP $3 SUBSEP $4
    ++tried[key]
    if ($5 == "-") next
    error = 100 * ($5 / truth[$3, $4] - 1)
    ++measured[key]
    sum[key] += absolute(error)
    signed[key] += error
    if (absolute(error) > absolute(largest[key])) largest[key] = error
  }
  $1 == "time" { time_pairs[$2, $3] = $4; time_ms[$2, $3] = $5 }
  END {
    order[++captures] = "one dish"
    for (i = 1; i <= captures; ++i)
      printf "| %s | %s | %s | %s | %s |\n", order[i] == "one dish" ? "**all with one dish**" : order[i], \
        cell("accurate", order[i]), cell("fast", order[i]), cell("best", order[i]), cell("paper", order[i])
  }' "$work/all"
