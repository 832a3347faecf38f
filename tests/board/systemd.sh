# In the guest, as a service of systemd's: a boot with nothing plugged in; see boot_unplugged.cpp.
. ./lines.sh
udevadm settle
modprobe vhci-hcd
./boot_unplugged ./mash_and_meatballs /etc/traygauge/station.toml
status=$?
[ $status = 0 ] || journalctl --no-pager -o short-monotonic -n 60 -u 'traygauge-*' -u systemd-modules-load
exit $status
