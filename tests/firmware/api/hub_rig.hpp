// A hub in a thread of its own, a station's link to it, and a client of its API. Whatever the client is
// answered is held against the description of the API, and fails the test where it does not fit.
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>

#include "firmware/base/file_descriptor.hpp"
#include "firmware/handover/hub_link.hpp"
#include "firmware/hub/hub.hpp"
#include "tests/firmware/api/api_description.hpp"
#include "tests/firmware/store/sample_scan.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {

// A client that listens to events.
struct Listening {
  FileDescriptor socket;
  Answer answer;  // with the events that have come
};

class HubRig {
 public:
  explicit HubRig(WebConfig web = {}, std::filesystem::path station_file = {});
  ~HubRig();
  HubRig(const HubRig&) = delete;
  HubRig& operator=(const HubRig&) = delete;

  Answer get(const std::string& target, const std::string& headers = {}) const;
  Answer post(const std::string& target, const std::string& body, const std::string& headers = {}) const;
  // With a Host among the headers that one is sent, else localhost.
  Answer request(const std::string& method, const std::string& target, const std::string& headers,
                 const std::string& body) const;
  // Waits for the first answer that has `until`, which an event's name is.
  Listening listen(const std::string& until, const std::string& headers = {}) const;
  // What comes further, until it has that, too.
  static std::string hear(const Listening& listening, const std::string& until);
  // The station's connection ends, which the hub knows when this returns.
  void lose_station();
  // The store's file is damaged, and no other can take its place.
  void lose_store();
  // "GET /api/v1/scans/{id}" and the role that it asks for, of all that the hub answers.
  std::map<std::string, std::string> routes() const;
  // ApiDescription::answer_name() of all that was answered.
  const std::set<std::string>& answers() const { return answers_; }

  // A scan with one item of so many ml, taken so many seconds after 2026-11-27 07:00:00 UTC.
  void store(int number, double volume_ml, int seconds = 0, const std::string& status = "ok");
  void store(const SampleScan& scan);
  // The hub ends and starts with the same store; the station has to connect again.
  void restart();

  const TemporaryFolder& folder() const { return folder_; }
  HubLink& station() { return *station_; }
  std::uint16_t port() const { return port_; }

 private:
  void start_hub();
  void start_loop();
  void stop_loop();
  void deliver(const ScanId& id, const std::string& document);
  Answer checked(Exchange exchange) const;

  WebConfig web_;
  std::filesystem::path station_file_;
  TemporaryFolder folder_;
  std::unique_ptr<Hub> hub_;
  std::unique_ptr<HubLink> station_;
  std::uint16_t port_ = 0;
  std::atomic<bool> stop_{false};
  std::thread thread_;
  mutable std::set<std::string> answers_;
};

}  // namespace traygauge::test
