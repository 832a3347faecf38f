# In the guest: the kernel's devices that the tests use, and where they are.
[ -e environment ] && . ./environment
export GTEST_COLOR=no
modprobe gpio-sim
modprobe vivid n_devs=1 node_types=0x1 num_inputs=1 input_types=0
modprobe uvcvideo nodrop=1
modprobe vhci-hcd
mount -t configfs configfs /sys/kernel/config 2>/dev/null
board=/sys/kernel/config/gpio-sim/board
mkdir -p $board/bank
echo 9 >$board/bank/num_lines
echo board >$board/bank/label
line=0
for name in TRIGGER GREEN YELLOW RED BLUE STEP DIR ENABLE HOME; do
  mkdir $board/bank/line$line
  echo $name >$board/bank/line$line/name
  line=$((line + 1))
done
echo 1 >$board/live
export TRAYGAUGE_BOARD_GPIO=/sys/devices/platform/$(cat $board/dev_name)/$(cat $board/bank/chip_name)
