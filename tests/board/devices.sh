# In the guest: the kernel's devices that the tests use, and where they are.
[ -e environment ] && . ./environment
export GTEST_COLOR=no
modprobe vivid n_devs=1 node_types=0x1 num_inputs=1 input_types=0
modprobe uvcvideo nodrop=1
modprobe vhci-hcd
. ./lines.sh
