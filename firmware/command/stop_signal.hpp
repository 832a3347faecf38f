// How a service manager or Ctrl-C ends the loop.
#pragma once

#include <atomic>

namespace traygauge {

// Becomes true at SIGINT or SIGTERM, which from now on do nothing else; a second one kills as usual.
const std::atomic<bool>& stop_on_signals();

}  // namespace traygauge
