# In the guest: a boot after a power cut, and load until the next one; see power_cuts.py, which wrote `moment`: RUN, the name
# of this boot, LAST=1 where no load follows, AWAY_S and THERE_S, how long the hub is, MARKS for cut_station, and libraries for
# station and hub.
. ./moment
exec 2>&1
disk=/dev/vda
for module in virtio_pci virtio_blk crc32c_generic ext4; do modprobe $module; done
# As an appliance does at boot; then whether that was enough.
./e2fsck -p $disk >fsck.txt
mended=$?
./e2fsck -fn $disk >>fsck.txt
damaged=$?
echo "FSCK $(grep -c 'recovering journal' fsck.txt) $mended $damaged"
[ $mended -lt 4 ] || { cat fsck.txt; exit 1; }
mkdir /data
mount -t ext4 $disk /data || exit 1
echo MOUNTED

cat >hub.toml <<TOML
[station]
name = "kitchen"
socket = "/tmp/hub"
folder = "/data/keep"
[hub]
store = "/data/results.db"
keep_free_mib = 0
TOML
mkdir -p /data/keep
start_hub() {
  LD_PRELOAD=$HUB_PRELOAD ./traygauge-hub hub --config hub.toml >>hub.log 2>&1 &
  hub=$!
}
station() { LD_PRELOAD=$STATION_PRELOAD ./cut_station /data/keep /tmp/hub "$RUN" "$1" "$MARKS" 2>>station.log; }

start_hub
waited=$(station 0) || { cat station.log hub.log; exit 1; }
echo "WAITED $waited"
kill $hub
wait $hub
./cut_check /data/results.db told
checked=$?
[ $checked = 0 ] || cat fsck.txt hub.log station.log
ls /data /data/keep | grep -e damaged
echo "CHECKED $checked"
[ $checked = 0 ] && [ -z "$LAST" ] || { umount /data; exit $checked; }

# Results wait until no more can; the hub comes, takes them while new ones come, and goes again.
station 1000000 >/dev/null &
while sleep $AWAY_S; do
  start_hub
  sleep $THERE_S
  kill -KILL $hub
done
