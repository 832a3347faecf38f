#!/bin/sh
# Tries `traygauge config check` and --last-good with the programs as they ship. Usage: config_check.sh BUILD_FOLDER CAPTURE
# DISHES
set -eu
program=$1/traygauge
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$2/card.png" "$folder"
cp -r "$3" "$folder"
file=$folder/station.toml
status=0

write() { # what stands in [hub] beside its store
  "$(dirname "$0")/../../support/write_station.sh" "$file" .
  printf '%s\n' "$1" >>"$file"
}

expect() { # STATUS TEXT PROGRAM ARGUMENTS…
  wanted=$1
  text=$2
  shift 2
  found=0
  "$@" >"$folder/said" 2>&1 || found=$?
  if [ "$found" != "$wanted" ] || ! grep -q "$text" "$folder/said"; then
    echo "$*: expected status $wanted and '$text', found $found and:"
    cat "$folder/said"
    status=1
  fi
}
check() { # STATUS TEXT
  expect "$1" "$2" "$program" config check "$file"
}

write 'listen = ["127.0.0.1:0"]'
check 0 'as expected for a station called kitchen; dishes: dinner oval soup'
check 0 'as expected for a hub'
write 'lisen = ["127.0.0.1:0"]'
check 2 "station.toml:24: hub.lisen: expected one of store"
write 'listen = ["*:0"]'
check 2 'hub.listen: .*no token file is named'
write 'listen = ["127.0.0.1:seven"]'
check 2 'hub.listen: .*expected ADDRESS:PORT'
write 'time_zone = "Europe/Atlantis"'
check 2 'hub.time_zone: expected'
echo 'aaaaaaaaaaaaaaaaaaaaaaaa ann' >"$folder/view.tokens"
chmod 644 "$folder/view.tokens"
write 'view_tokens = "view.tokens"'
check 2 'view.tokens'
chmod 600 "$folder/view.tokens"
check 0 'as expected for a hub'
write ''
sed -i 's/card.png/other.png/' "$file"
check 2 'other.png'
write ''
sed -i 's/^line = /lin = /' "$file"
check 2 'station.toml:4: button.lin: expected one of'
write ''
echo '[trays]' >>"$file"
echo 'dishes = ["bowl"]' >>"$file"
check 2 'trays.dishes\[0\]: expected one of dinner, oval, soup, found bowl'
expect 1 'FAIL  trays: .*trays.dishes\[0\]: expected one of dinner, oval, soup, found bowl' "$program" check "$file"
sed -i 's/"bowl"/"soup"/' "$file"
expect 1 'ok    trays: dishes soup' "$program" check "$file"
write '= 3'
check 2 'station.toml:24: '
write ''
sed -i '1i version = 1' "$file"
check 0 'as expected for a hub'
sed -i 's/^version = 1/version = 2/; s/^line = /lin = /' "$file"
check 2 'station.toml:1: version: expected version 1 of a station file, .* a newer program wrote this file'
rm "$file"
check 2 'No such file'

# The last good one counts, as long as it does not want to stop.
hub() { # STATUS TEXT
  expect "$1" "$2" "$program" hub --config "$file" --last-good "$folder/last-good.toml" --check
}
write ''
hub 0 'as expected for a hub'
write 'nonsense = 1'
hub 0 'not the one that was written, but the last good one: .*station.toml:24: hub.nonsense'
write ''
sed -i '1i on_bad_config = "stop"' "$file"
hub 0 'as expected for a hub'
write 'nonsense = 1'
hub 2 'station.toml:24: hub.nonsense'
write ''
sed -i '1i on_bad_config = "go on"' "$file"
check 2 'station.toml:1: on_bad_config: expected "keep" or "stop"'

# The station goes on to its devices, of which there are none here, with the last good one.
cat >"$folder/devices.sh" <<END
timeout -s INT 1 "$program" station --devices "hardware:$file" --last-good "$folder/station-good.toml" || true
END
write ''
expect 0 '^button TRIGGER: The device' sh "$folder/devices.sh"
write ''
sed -i 's/^line = /lin = /' "$file"
expect 0 'the last good one: .*station.toml:4: button.lin' sh "$folder/devices.sh"
exit "$status"
