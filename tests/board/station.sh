# In the guest: the whole station on the kernel's devices, in each of its modes.
. ./devices.sh
# Beside the program, as it is installed.
mkdir -p config
cp -r network config
status=0
for mode in arm double twin; do
  echo "mode $mode"
  ./station_cycle ./traygauge ./mash_and_meatballs $mode || status=1
done
exit $status
