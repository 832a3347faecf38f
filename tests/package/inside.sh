#!/bin/sh
# In a fresh Debian: installs, upgrades, downgrades, removes and purges the packages in /packages. Systemd does not run here; what
# the packages ask of it is written down by a program in its place, and the hub is started as its unit would.
set -eu
programs=/usr/libexec/traygauge/programs
previous=/usr/libexec/traygauge/previous
active=/usr/libexec/traygauge/active
station=/etc/traygauge/station.toml
data=/var/lib/traygauge
log=/tmp/log
asked=/tmp/asked-of-systemd

good() { echo "ok    $*"; }
bad() {
  echo "FAIL  $*"
  cat "$log"
  exit 1
}
expect() { # TEXT COMMAND…
  text=$1
  shift
  "$@" >>"$log" 2>&1 || bad "$text"
  good "$text"
}
expect_not() {
  text=$1
  shift
  ! "$@" >>"$log" 2>&1 || bad "$text"
  good "$text"
}
install() { apt-get install -y --no-install-recommends --allow-downgrades -o Dpkg::Options::=--force-confold "$@"; }
begin() {
  echo "== $*"
  : >"$log"
  : >"$asked"
}
every_file() {
  find / -xdev \( -path /proc -o -path /sys -o -path /dev -o -path /run -o -path /tmp -o -path /packages -o -path /var/log \
    -o -path /var/cache -o -path /var/lib/apt -o -path /var/lib/dpkg -o -name '*-' -path '/etc/*' -o -path /etc/.pwd.lock \
    -o -path /usr/local/bin/systemctl \) -prune -o -printf '%y %m %u %p\n' | sort
}
# Whether the running hub was started from the program in that folder. Under emulation /proc/PID/exe is the emulator, so its maps are
# read; by inode, because programs and previous are hard links of the same file.
hub_is_of() {
  awk -v inode="$(stat -c %i "$1/traygauge-hub")" '$5 == inode { found = 1 } END { exit !found }' "/proc/$hub/maps"
}
in_use() { [ "$(readlink "$active")" = "$1" ]; }
# By the line of its unit that systemd would start.
start_hub() {
  line=$(sed -n '/^ExecStart=/,/[^\\]$/p' "$units/traygauge-hub.service" | sed 's/^ExecStart=//; s/\\$//' | tr -d '\n')
  # Not the words of the one before.
  rm -f /tmp/hub.log
  touch /tmp/hub.log
  # shellcheck disable=SC2086 # words of a command
  setpriv --reuid=traygauge-hub --regid=traygauge --init-groups $line >/tmp/hub.log 2>&1 &
  hub=$!
  tries=0
  until grep -q 'stores results' /tmp/hub.log; do
    tries=$((tries + 1))
    if [ "$tries" = 100 ] || ! kill -0 "$hub"; then bad "the hub does not start: $(cat /tmp/hub.log)"; fi
    sleep 0.1
  done
}
measure_one() { # through the hub, by the programs that the units start
  setpriv --reuid=traygauge-station --regid=traygauge --init-groups "$active/traygauge" station \
    --devices simulator:/usr/share/traygauge/self-check --scans 1 --hub "$data/hub/hub" --keep "$data/hub/waiting" --name kitchen
}

if [ "$IS_EMULATED" = no ]; then # else lintian has run outside
  begin "lintian"
  expect "lintian finds nothing" lintian --fail-on error,warning --allow-root /packages/first.deb /packages/simulator.deb
  cat "$log"
fi

begin "a fresh system with what the packages depend on"
apt-get update >>"$log" 2>&1 || bad "apt-get update"
for deb in first simulator; do
  needs=$(dpkg-deb --field "/packages/$deb.deb" Depends | sed -E 's/traygauge \([^)]*\),? *//; s/, *$//')
  expect "dependencies of $deb: $needs" apt-get satisfy -y --no-install-recommends "$needs"
done
cat >/usr/local/bin/systemctl <<FAKE
#!/bin/sh
echo "\$*" >>$asked
FAKE
chmod +x /usr/local/bin/systemctl
# Else scripts of packages would look for it in /usr alone.
echo "DPkg::Path \"$PATH\";" >/etc/apt/apt.conf.d/90path
mkdir -p /run/systemd/system
every_file >/tmp/before

begin "installation"
expect "both packages are installed" install /packages/first.deb /packages/simulator.deb
expect "it says what to do" grep -q '^traygauge: nothing was started' "$log"
expect_not "no unit was started or enabled" grep -E 'traygauge.*|(start|enable|restart) .*traygauge' "$asked"
expect_not "no unit begins at boot" ls /etc/systemd/system/multi-user.target.wants/traygauge-hub.service
expect "the programs are in use" in_use programs
for user in traygauge-station traygauge-hub; do expect "user $user" getent passwd "$user"; done
units=$(dirname "$(dpkg -L traygauge | grep '/traygauge-hub.service$')")
expect "systemd understands the units" systemd-analyze verify --man=no "$units/traygauge-hub.service" "$units/traygauge-station.service"
expect "--version" traygauge --version
sed -n '/^traygauge [0-9]/,$p' "$log"
traygauge measure /usr/share/traygauge/demo/fish_and_potatoes >/tmp/measured || bad "measure"
cat /tmp/measured
expect "the demo plays two trays" env DEMO_SCANS=2 traygauge-demo
expect "the station measures its volumes as ever" /packages/demo_volumes.sh "$active/traygauge-station" \
  /usr/share/traygauge/demo /packages/demo_volumes.txt
expect "the renderer knows its sets" traygauge-simulate list
expect "traygauge card makes a card" traygauge card --out /tmp
for program in "$programs"/traygauge*; do expect "${program##*/} finds its libraries" "$program" --help; done
expect_not "the station file lacks what only the site knows" traygauge self-check "$station"
expect "nothing else is wrong" grep -q '^FAIL  configuration: .*lens' "$log"
expect "and it says so alone" sh -c "[ \$(grep -c '^FAIL' $log) = 1 ]"
expect "packages are whole" dpkg --verify traygauge traygauge-simulator

begin "a station at work"
# It depends on this very version.
expect "the simulator goes" apt-get purge -y traygauge-simulator
mkdir -p "$data/hub/waiting"
chown traygauge-hub:traygauge "$data/hub"
chown traygauge-station:traygauge "$data/hub/waiting"
chmod 750 "$data/hub"
/support/write_station.sh "$station" "$data/hub"
cp /packages/card.png /etc/traygauge
echo 'aaaaaaaaaaaaaaaaaaaaaaaa ann' >/etc/traygauge/view.tokens
chmod 600 /etc/traygauge/view.tokens
chown traygauge-hub /etc/traygauge/view.tokens
printf 'listen = ["127.0.0.1:0"]\nview_tokens = "/etc/traygauge/view.tokens"\n' >>"$station"
sum=$(sha256sum "$station")
expect "self-check passes" traygauge self-check "$station"
start_hub
expect "a tray is measured and stored" measure_one

begin "an upgrade whose hub does not work"
expect_not "the installation fails" install /packages/no_hub.deb
expect "it says what failed" grep -q 'fails here what the previous one passes: hub' "$log"
expect "and what to do" grep -q 'dpkg --configure traygauge' "$log"
expect "the old hub still runs" kill -0 "$hub"
expect "by the old program" hub_is_of "$previous"
expect "the old programs are in use" in_use previous
expect_not "no unit was restarted" grep restart.*traygauge "$asked"
expect "the old programs pass their self-check" "$active/traygauge" self-check "$station"
expect "a tray is measured and stored" measure_one
kill "$hub"
wait "$hub" || true
start_hub
expect "after a boot the old hub starts" hub_is_of "$previous"
expect "with its page" test -f "$previous/page/index.html"
expect_not "another attempt fails as well" dpkg --configure traygauge
expect "the old programs are in use" in_use previous

begin "a good upgrade after it"
expect "the installation ends well" install /packages/good.deb
expect "the new programs are in use" in_use programs
expect_not "the old ones are gone" test -e "$previous"
expect "both units are restarted, the hub first" sh -c "grep -o 'try-restart.*traygauge-[a-z]*' $asked | sed 's/.*-//' | xargs | grep -qx 'hub station'"
expect "the edited station file is kept" sh -c "[ \"\$(sha256sum $station)\" = \"$sum\" ]"
expect "the package's lies beside it" grep -q 'A key that is new' "$station.dpkg-dist"
expect "the tokens are kept" grep -q ann /etc/traygauge/view.tokens
expect "the old hub runs until systemd restarts it" kill -0 "$hub"
kill "$hub"
wait "$hub" || true
start_hub
expect "the new hub takes the store over" hub_is_of "$programs"
expect "a tray is measured and stored" measure_one

begin "upgrades of which others do not work"
expect_not "a station that does not measure: the installation fails" install /packages/no_station.deb
expect "it says what failed" grep -q 'fails here what the previous one passes: measurement' "$log"
expect "the old programs are in use" in_use previous
expect_not "a program that does not run: the installation fails" install /packages/no_program.deb
expect "it says what failed" grep -q 'fails here what the previous one passes: programs' "$log"
expect "the old programs are in use" in_use previous
expect "they work" "$active/traygauge" self-check "$station"

expect_not "one that dpkg refuses, after it: the installation fails" install /packages/refused.deb
expect "the old programs are in use" in_use previous
expect "they work" "$active/traygauge" self-check "$station"

begin "a power cut between unpacking and configuring"
expect "good again" install /packages/good.deb
expect "unpacked" dpkg --unpack /packages/no_hub.deb
expect "the next boot has the old programs" in_use previous
expect "they work" "$active/traygauge" self-check "$station"
expect "unpacked once more, over what never passed" dpkg --unpack /packages/no_station.deb
expect "the old programs are still there" "$active/traygauge" self-check "$station"
expect "good again" install /packages/good.deb
expect "the new programs are in use" in_use programs

begin "a package that dpkg refuses"
expect_not "the installation fails" install /packages/refused.deb
expect "the programs are in use as before" in_use programs
expect_not "nothing is left aside" test -e "$previous"
expect "they work" "$active/traygauge" self-check "$station"

begin "a station file that neither version takes"
cp "$station" /tmp/kept.toml
sed -i 's/^store = /stor = /' "$station"
expect "the upgrade goes on" install /packages/first.deb
expect "and says so" grep -q 'the self-check fails as it did with the previous version' "$log"
expect "the installed programs are in use" in_use programs
cp /tmp/kept.toml "$station"

begin "a downgrade"
expect "up" install /packages/good.deb
expect "down again" install /packages/first.deb
expect "the older programs are in use" in_use programs
expect "self-check passes" traygauge self-check "$station"
expect "the edited station file is kept" sh -c "[ \"\$(sha256sum $station)\" = \"$sum\" ]"
kill "$hub"
wait "$hub" || true
expect "up to one that takes every store" install /packages/every_store.deb
printf '\001' | dd of="$data/hub/results.db" bs=1 seek=62 conv=notrunc status=none
expect_not "down to one that does not take the newer store" install /packages/first.deb
expect "it says what failed" grep -q 'FAIL  hub: .*the store has version 25[0-9], this program knows versions up to' "$log"
expect "the newer programs are in use" in_use previous
printf '\000' | dd of="$data/hub/results.db" bs=1 seek=62 conv=notrunc status=none
expect "with the older store, the second attempt ends well" dpkg --configure traygauge
expect "the older programs are in use" in_use programs

begin "removal"
mkdir -p /etc/systemd/system/multi-user.target.wants
ln -s "$units/traygauge-hub.service" /etc/systemd/system/multi-user.target.wants/traygauge-hub.service
expect "removed" apt-get remove -y traygauge
expect "the units were stopped" grep -q 'stop.*traygauge-station.service traygauge-hub.service' "$asked"
expect_not "no program is left" test -e /usr/libexec/traygauge
expect "configuration stays" test -s "$station"
expect "results stay" test -s "$data/hub/results.db"
expect "installed again" install /packages/first.deb /packages/simulator.deb
expect "it goes on with them" traygauge self-check "$station"

begin "purge"
expect "purged" apt-get purge -y traygauge traygauge-simulator
expect "it says that it deletes the results" grep -q "^traygauge: deleting $data: " "$log"
expect "and the configuration" grep -q '^traygauge: deleting /etc/traygauge: ' "$log"
every_file >/tmp/after
diff /tmp/before /tmp/after >>"$log" 2>&1 || bad "files are as before"
good "files are as before"
echo "all passed on $RELEASE $(dpkg --print-architecture)"
