#!/bin/sh
# Both profiles on several sets, side by side.
# Usage: evaluate_sets.sh PROGRAM OUT SEEDS SET…; PROGRAM is traygauge. Prints a Markdown row for each profile and set; what
# `traygauge evaluate` says and writes comes to OUT/SET-PROFILE. What is there already is not measured again.
set -eu
program=$1
out=$2
seeds=$3
shift 3

echo "| set | profile | captures | volumes | MAPE % (95 %) | refused % | as 100 % | bias % (95 %) | limits of agreement % | within 10 %, 20 % | worst % | CV %, over seeds | in two sigma %, median sigma % |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
for set_folder in "$@"; do
  for profile in best paper; do
    name=$(basename "$set_folder")-$profile
    said=$out/$name/said.txt
    if [ ! -s "$said" ]; then
      mkdir -p "$out/$name"
      # Profile paper measures no trays with several dishes.
      "$program" evaluate "$set_folder" --profile "$profile" --runs "$seeds" --out "$out/$name" >"$said.part" || continue
      mv "$said.part" "$said"
    fi
    # Of the last table the foods, as the profile measures them.
    awk -F '  +' -v set_name="$(basename "$set_folder")" -v profile="$profile" '
      { sub(/^ +/, "") }
      /^all captures/ { in_table = 1; column = 2; for (i = 2; i <= NF; ++i) if ($i == "foods, flat dish") column = i }
      !in_table { next }
      { value = $column; gsub(/ %/, "", value) }
      $1 == "95 % interval" { interval[last] = value; next }
      { last = $1; of[$1] = value }
      /^intervals: / { captures = $0; gsub(/[^0-9]/, "", captures); in_table = 0 }
      END {
        refused = of["refused"]; sub(/.*\(/, "", refused); sub(/\).*/, "", refused)
        printf "| %s | %s | %s | %s | %s (%s) | %s | %s | %s (%s) | %s | %s, %s | %s | %s, %s | %s, %s |\n",
          set_name, profile, captures, of["volumes"], of["MAPE"], interval["MAPE"], refused, of["a refusal as 100 % error"],
          of["bias"], interval["bias"], of["95 % limits of agreement"], of["within 10 %"], of["within 20 %"], of["worst"],
          of["CV over pairs and seeds"], of["CV over the seeds of a pair"], of["truth within two sigma"], of["median sigma/volume"]
      }' "$said"
  done
done
