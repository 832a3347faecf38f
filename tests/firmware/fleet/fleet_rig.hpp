// A store and a fleet, moved on by hand as the hub's loop does; and a listener that may give receipts.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/fleet/fleet.hpp"
#include "tests/firmware/store/memory_folder.hpp"

namespace traygauge::test {

// What takes minutes in the kitchen takes milliseconds here.
FleetLimits quick_fleet_limits();

// Of a broker at this machine, without encryption.
FleetConfig fleet_config(std::uint16_t port);

// Hears everything below traygauge/ and says what a test wants.
class Listener {
 public:
  explicit Listener(const BrokerConfig& broker, const std::string& client_id = "listener");

  void step();
  // Every further scan and correction is receipted; `may` says which.
  void give_receipts(std::function<bool(const std::string& id)> may = [](const std::string&) {
    return true;
  });
  void say(const std::string& topic, const std::string& payload);
  bool is_connected() const { return link_->is_connected(); }

  std::vector<BrokerMessage> heard;
  // Of the events, in the order in which they came; each as often as it came.
  std::vector<std::string> ids;
  // The last payload; empty: none came.
  std::string last(const std::string& topic) const;

 private:
  std::unique_ptr<BrokerLink> link_;
  std::function<bool(const std::string&)> may_receipt_;
};

class FleetRig {
 public:
  explicit FleetRig(const FleetConfig& config, FleetLimits limits = quick_fleet_limits());

  // Throw where it is not stored.
  void put(std::uint64_t number);
  void put_long(std::uint64_t number, std::size_t bytes);
  void correct(std::uint64_t number, const std::string& food);
  // As after a crash: what was not noted is forgotten.
  void restart();
  void stop() { fleet_.reset(); }

  // One round of the loop, and of the listeners'.
  void step(std::chrono::milliseconds longest_wait = std::chrono::milliseconds(5));
  void add(Listener& listener) { listeners_.push_back(&listener); }
  bool run_until(const std::function<bool()>& is_done,
                 std::chrono::milliseconds limit = std::chrono::milliseconds(8000));
  // How often the loop went round.
  int run_for(std::chrono::milliseconds time);

  HubStore& hub_store() { return *store_; }
  Store& store() { return *store_->store(); }
  Fleet& fleet() { return *fleet_; }
  const FleetState& state() const { return fleet_->state(); }
  std::int64_t waiting() const;
  const std::string& log() const { return log_; }
  bool logged(const std::string& text) const { return log_.find(text) != std::string::npos; }
  std::chrono::microseconds longest_call() const { return longest_call_; }
  std::string health = R"({"status":"ok","parts":[]})";

 private:
  MemoryFolder folder_;
  FleetConfig config_;
  FleetLimits limits_;
  std::optional<HubStore> store_;
  std::unique_ptr<Fleet> fleet_;
  std::vector<Listener*> listeners_;
  std::string log_;
  std::chrono::microseconds longest_call_{0};
};

}  // namespace traygauge::test
