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
  // "disk", "clock", "webhook", "fleet", "station kitchen", "camera of kitchen", "queue of kitchen", "drift
  // of kitchen"
  std::string name;
  HealthState state = HealthState::ok;
  std::string message;  // empty where all is well
};

struct Health {
  std::vector<HealthPart> parts;
  HealthState worst() const;
};

// What is looked at.
struct HealthSubjects {
  const HubStore& store;
  const StationInbox& inbox;
  const DriftWatch& drift;
  const Webhook* webhook = nullptr;  // null: nobody is told
  const Fleet* fleet = nullptr;      // null: no broker is told
  std::string configuration_problem;
  WallTime now;
};

Health examine_health(const HealthSubjects& subjects);
Health examine_health(const HubSite& site);

// As /health and the broker have it.
std::string health_json(const Health& health);

}  // namespace traygauge
