# In the guest: the whole station on the kernel's devices.
. ./devices.sh
./station_cycle ./traygauge ./mash_and_meatballs
