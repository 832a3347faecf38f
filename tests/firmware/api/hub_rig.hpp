// A hub in a thread of its own, a station's link to it, and a client of its API.
#pragma once

#include <atomic>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "firmware/handover/hub_link.hpp"
#include "firmware/hub/hub.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {

struct Answer {
  int status = 0;
  std::string head;
  std::string body;

  nlohmann::json json() const { return nlohmann::json::parse(body); }
};

class HubRig {
 public:
  explicit HubRig(WebConfig web = {});
  ~HubRig();
  HubRig(const HubRig&) = delete;
  HubRig& operator=(const HubRig&) = delete;

  Answer get(const std::string& target, const std::string& headers = {}) const;
  Answer post(const std::string& target, const std::string& body, const std::string& headers = {}) const;
  // A scan with one item of so many ml, taken so many seconds after 2026-11-27 07:00:00 UTC.
  void store(int number, double volume_ml, int seconds = 0, const std::string& status = "ok");

  const TemporaryFolder& folder() const { return folder_; }
  HubLink& station() { return *station_; }
  std::uint16_t port() const { return port_; }

 private:
  TemporaryFolder folder_;
  std::unique_ptr<Hub> hub_;
  std::unique_ptr<HubLink> station_;
  std::uint16_t port_ = 0;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace traygauge::test
