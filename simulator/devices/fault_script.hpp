// Faults that a simulated device plays: what, after how many calls, how often.
#pragma once

#include <vector>

#include "drivers/device_status.hpp"

namespace traygauge {

struct Fault {
  DeviceCode code = DeviceCode::io_error;
  int after_calls = 0;  // calls that still work
  int times = 1;        // calls that then fail; kForever: all
  static constexpr int kForever = -1;
};

class FaultScript {
 public:
  // Counts `after_calls` from now. Of several faults that are due, the one added first is played.
  void add(const Fault& fault);
  void clear() { pending_.clear(); }
  // To be asked once a call: ok, or the failure of this call.
  DeviceStatus next();

 private:
  std::vector<Fault> pending_;
};

}  // namespace traygauge
