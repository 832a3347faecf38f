// The faults that one simulated device plays: what, when, how often.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "drivers/clock.hpp"
#include "drivers/device_status.hpp"
#include "simulator/devices/fault.hpp"

namespace traygauge {

class FaultScript {
 public:
  // Counts `after_calls` from now. Of several faults that are due, the one added first is played. `seed`
  // draws the calls of a share.
  void add(const Fault& fault, std::uint64_t seed = 0);
  void clear() { *this = {}; }
  bool empty() const { return pending_.empty(); }

  // To be asked once a call that these kinds can spoil, and kind `reports`, which spoils any: kind none when
  // it works. After `off` every call fails until a start works.
  FaultAction next(Instant now, FaultKinds kinds);
  // To be asked once a start.
  DeviceStatus next_start(Instant now);
  bool is_off() const { return is_off_; }

 private:
  struct Pending {
    Fault fault;
    std::mt19937_64 random;

    bool is_spent() const { return fault.times == 0; }
    bool is_due(Instant now);
  };

  FaultAction play(Instant now, FaultKinds kinds);

  std::vector<Pending> pending_;
  bool is_off_ = false;
};

}  // namespace traygauge
