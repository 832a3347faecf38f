// What a program takes from itself before it works: a process with the camera and no network, a process with
// the network and no camera. The kernel holds it to that (seccomp), also where systemd does not.
#pragma once

#include "firmware/base/expected.hpp"

namespace traygauge {

// From now on this process, with all its threads, opens no sockets but Unix ones, starts no program, and
// leaves no memory behind when it crashes: its pictures stay in it. Fails where the kernel has no such
// filter.
Expected<void> confine_station();

// From now on this process controls no device: the call by which camera, GPIO and serial port are driven
// (ioctl) is refused, and it starts no program. Which files it may open at all, only the service's user and
// unit can say.
Expected<void> confine_hub();

}  // namespace traygauge
