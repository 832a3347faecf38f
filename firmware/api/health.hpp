// Whether the hub and its stations work, and which part does not.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware/api/hub_site.hpp"

namespace traygauge {

enum class HealthState : std::uint8_t { ok, warning, failing };
const char* name(HealthState state);

struct HealthPart {
  // "disk", "clock", "webhook", "station kitchen", "camera of kitchen", "queue of kitchen", "drift of
  // kitchen"
  std::string name;
  HealthState state = HealthState::ok;
  std::string message;  // empty where all is well
};

struct Health {
  std::vector<HealthPart> parts;
  HealthState worst() const;
};

Health examine_health(const HubSite& site);

}  // namespace traygauge
