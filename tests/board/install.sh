# In the guest, before it boots: installs what is tested where it belongs, as config/systemd says in its first lines. The units
# stay as they are. BOARD_NO_MODULES=1 leaves modules-load.conf out.
. ./environment
set -e
mkdir -p /usr/libexec/traygauge/programs
mv traygauge traygauge-station traygauge-hub /usr/libexec/traygauge/programs
ln -s programs /usr/libexec/traygauge/active
ln -s ../libexec/traygauge/programs/traygauge /usr/bin/traygauge
mkdir -p /usr/lib/modules-load.d
cp systemd/*.service /usr/lib/systemd/system
cp systemd/sysusers.conf /usr/lib/sysusers.d/traygauge.conf
[ "$BOARD_NO_MODULES" = 1 ] || cp systemd/modules-load.conf /usr/lib/modules-load.d/traygauge.conf
cp 60-traygauge-gpio.rules /etc/udev/rules.d
SYSTEMD_OFFLINE=1 systemctl --quiet enable traygauge-hub traygauge-station
