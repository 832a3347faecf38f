// Tells a store behind an MQTT broker of every scan and every correction: at least once, however long broker
// or store are away. firmware/fleet/README.md has the topics.
#pragma once

#include <poll.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/back_off.hpp"
#include "firmware/base/expected.hpp"
#include "firmware/broker/broker_link.hpp"
#include "firmware/fleet/fleet_config.hpp"
#include "firmware/fleet/fleet_window.hpp"
#include "firmware/hub/hub_store.hpp"

namespace traygauge {

// Among the destinations of the store.
inline constexpr const char* kFleetDestination = "fleet";

struct FleetLimits {
  BrokerLimits broker;
  std::chrono::milliseconds receipt_within{30 * 1000};
  std::chrono::milliseconds shortest_wait{
      2000};  // where nothing is receipted; doubled after each further time
  std::chrono::milliseconds longest_wait{5 * 60 * 1000};
  // For a message that is not receipted while others are.
  std::chrono::milliseconds shortest_postponement{60 * 1000};
  std::chrono::milliseconds longest_postponement{60 * 60 * 1000};
  int attempts_to_tell = 3;  // of one message, before people are told of it
  // Published and not receipted, at most; one message is always sent, however long.
  std::size_t window_messages = 32;
  std::size_t window_bytes = 1024UL * 1024;
  std::size_t sent_at_once = 8;  // so that the hub's loop goes on
  // Noted in one go; so many may be told a second time after a power cut.
  std::size_t noted_at_once = 64;
  std::chrono::milliseconds note_within{1000};
  std::chrono::milliseconds health_every{10 * 1000};
  // What waits for a shorter time is no news.
  std::chrono::milliseconds patience{60 * 1000};
};

struct FleetState {
  std::uint64_t published = 0;  // scans and corrections since the start, each time it was sent
  std::uint64_t delivered = 0;
  std::uint64_t failed_attempts = 0;  // messages, or whole windows, that nobody receipted
  std::uint64_t ignored = 0;          // messages to the hub that are no receipts
  std::string last_failure;           // of deliveries, since the last one; empty: none
  // What is not receipted while others are: how many bytes, by their ids.
  std::map<std::string, std::size_t> undeliverable;
  // Since when something has waited and nothing was delivered; none: nothing waits.
  std::optional<std::chrono::steady_clock::time_point> waiting_since;
};

// What the hub says of its health, as JSON.
using HealthText = std::function<std::string()>;

// Used by the hub's loop: add_descriptors(), timeout(), attend().
class Fleet {
 public:
  // Whether start() would take this configuration. The failure names key and file.
  static Expected<void> check(const FleetConfig& config);
  static Expected<std::unique_ptr<Fleet>> start(const FleetConfig& config, HubStore& store, HealthText health,
                                                FleetLimits limits = {});
  Fleet(const Fleet&) = delete;
  Fleet& operator=(const Fleet&) = delete;

  // What has to be known of the configuration, for the log; empty: nothing.
  std::string warning() const { return link_->warning(); }

  void add_descriptors(std::vector<pollfd>& descriptors) const { link_->add_descriptors(descriptors); }
  // Until attend() has to be called at the latest.
  std::chrono::milliseconds timeout() const;
  // Gets on with what is under way and begins what is due. Returns sentences for the log.
  std::vector<std::string> attend();

  const FleetState& state() const { return state_; }
  bool is_connected() const { return link_->is_connected(); }
  // What people should know, as sentences; empty: all is well.
  std::string trouble() const;
  // How many events wait.
  Expected<std::int64_t> count_waiting() const;

 private:
  using SteadyTime = std::chrono::steady_clock::time_point;

  Fleet(FleetConfig config, std::unique_ptr<BrokerLink> link, HubStore& store, HealthText health,
        const FleetLimits& limits);
  std::string topic(const char* what) const;
  bool has_waited_long() const;
  bool has_room() const;

  void follow_store();
  void follow_link(const BrokerNews& news);
  void greet();
  void tell_home_assistant();
  void tell_health(bool is_first);
  void take_message(const BrokerMessage& message);
  void settle(const InFlight& entry);
  void note_lost();
  Expected<void> work();
  Expected<void> note_delivered();
  Expected<void> look_for_overdue();
  Expected<void> postpone(const InFlight& entry, const std::string& why);
  Expected<void> fill();
  Expected<void> find_waiting();
  Expected<void> send_next();
  void pause(const std::string& problem);
  void say(const std::string& problem);

  FleetConfig config_;
  std::unique_ptr<BrokerLink> link_;
  HubStore& store_;
  HealthText health_;
  FleetLimits limits_;
  BackOff back_off_;
  FleetState state_;
  std::uint64_t opening_ = 0;             // of the store that the keys below belong to
  std::vector<PendingDelivery> waiting_;  // to be sent next, the last one first
  FleetWindow window_;
  std::vector<DeliveryKey> done_;  // delivered and not noted yet
  SteadyTime note_at_;
  SteadyTime next_work_;  // with the store
  SteadyTime next_send_;
  SteadyTime last_receipt_;
  bool is_cautious_ = false;   // one message at a time: the last connection broke without a receipt
  bool has_receipts_ = false;  // of this connection
  SteadyTime health_at_;
  std::string told_health_;
  std::string last_said_;
  std::vector<std::string> sentences_;
};

}  // namespace traygauge
