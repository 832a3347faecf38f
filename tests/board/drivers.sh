# In the guest: the contract tests of every driver and the tests with faults, on the kernel's devices.
. ./devices.sh
TRAYGAUGE_BOARD_CAMERAS=
for format in YUYV NV12 GREY RGB24 BGR24 RGGB8 BGGR10 GRBG12; do
  TRAYGAUGE_BOARD_CAMERAS="$TRAYGAUGE_BOARD_CAMERAS name:vivid,640,360,$format"
done
export TRAYGAUGE_BOARD_CAMERAS
status=0
./drivers_test --gtest_brief=1 --gtest_filter='*/*Contract.*v4l2_*:*/*Contract.*gpio_sim*:-*model*' || status=1
./board_test --gtest_brief=1 || status=1
exit $status
