# In the guest: gpio-sim's chip with the lines that the tests use, and where it is.
modprobe gpio-sim
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
