# In the guest: what uses GPIO lines, for another version of libgpiod.
. ./devices.sh
status=0
./drivers_test --gtest_brief=1 --gtest_filter='*/*Contract.*gpio_sim*' || status=1
./board_test --gtest_brief=1 --gtest_filter='ButtonOnKernel.*' || status=1
exit $status
