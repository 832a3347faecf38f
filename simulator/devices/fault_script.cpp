#include "simulator/devices/fault_script.hpp"

#include <algorithm>

namespace traygauge {

void FaultScript::add(const Fault& fault) {
  pending_.push_back(fault);
}

DeviceStatus FaultScript::next() {
  DeviceStatus status;
  for (Fault& fault : pending_) {
    if (fault.after_calls > 0) {
      --fault.after_calls;
    } else if (status.ok() && fault.times != 0) {
      status = fault.code;
      if (fault.times != Fault::kForever) --fault.times;
    }
  }
  std::erase_if(pending_, [](const Fault& fault) { return fault.after_calls == 0 && fault.times == 0; });
  return status;
}

}  // namespace traygauge
