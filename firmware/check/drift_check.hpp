// What the hub has to say of the station that is checked.
#pragma once

#include "firmware/check/device_check.hpp"
#include "firmware/config/hub_tables.hpp"

namespace traygauge {

// Asks the running hub whether the station's last trays drift; waits a second for it at most. A hub that does
// not run is no fault of a device: the text says that nothing is known.
CheckResult check_drift(const HandoverConfig& handover);

}  // namespace traygauge
