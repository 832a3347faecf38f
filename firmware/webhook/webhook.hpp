// Tells a receiver of every scan and every correction by HTTP: at least once, in order, however long it is
// away.
#pragma once

#include <poll.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/back_off.hpp"
#include "firmware/base/expected.hpp"
#include "firmware/config/hub_tables.hpp"
#include "firmware/hub/hub_store.hpp"
#include "firmware/webhook/http_sender.hpp"
#include "firmware/webhook/webhook_address.hpp"

namespace traygauge {

// Among the destinations of the store.
inline constexpr const char* kWebhookDestination = "webhook";

struct WebhookLimits {
  std::chrono::milliseconds connect_within{5000};
  std::chrono::milliseconds answer_within{15000};
  std::chrono::milliseconds shortest_wait{1000};  // after a failure; doubled after each further one
  std::chrono::milliseconds longest_wait{5 * 60 * 1000};
  // Noted in one go, so that a card is not written for each of a thousand that waited. So many may be told a
  // second time after a power cut.
  std::size_t noted_at_once = 16;
  // A receiver that is away for a shorter time is no news.
  std::chrono::milliseconds patience{60 * 1000};
};

struct WebhookState {
  std::uint64_t delivered = 0;  // since the start
  std::uint64_t failed_attempts = 0;
  std::string last_failure;  // since the last delivery; empty: none
  bool is_refused = false;   // the receiver says that the message, not the moment, is wrong
  // Since something has been waiting without a break; none: nothing waits.
  std::optional<std::chrono::steady_clock::time_point> waiting_since;
};

// Used by the hub's loop: add_descriptors(), timeout(), attend().
class Webhook {
 public:
  // Whether start() would take this configuration. The failure names key and file.
  static Expected<void> check(const WebhookConfig& config);
  static Expected<std::unique_ptr<Webhook>> start(const WebhookConfig& config, HubStore& store,
                                                  WebhookLimits limits = {});
  Webhook(const Webhook&) = delete;
  Webhook& operator=(const Webhook&) = delete;

  // What has to be known of the configuration, for the log; empty: nothing.
  std::string warning() const;

  void add_descriptors(std::vector<pollfd>& descriptors) const { sender_.add_descriptors(descriptors); }
  // Until attend() has to be called at the latest; none: as late as one likes.
  std::optional<std::chrono::milliseconds> timeout() const;
  // Gets on with what is under way and begins what is due. Returns sentences for the log.
  std::vector<std::string> attend();

  const WebhookState& state() const { return state_; }
  // Whether people should know that something waits.
  bool has_waited_long() const;
  // How many events wait.
  Expected<std::int64_t> count_waiting() const;

 private:
  using SteadyTime = std::chrono::steady_clock::time_point;

  Webhook(WebhookAddress address, std::string secret, HttpSender sender, HubStore& store,
          const WebhookLimits& limits);
  void follow_store();
  void finish(const SendOutcome& outcome);
  void begin();
  Expected<void> note_delivered();
  Expected<void> find_waiting();
  Expected<bool> begin_next();
  void wait_after(const std::string& problem, BackOff::Milliseconds wait);
  void say(const std::string& sentence);

  WebhookAddress address_;
  std::string secret_;  // empty: messages are not signed
  HttpSender sender_;
  HubStore& store_;
  WebhookLimits limits_;
  BackOff back_off_;
  WebhookState state_;
  std::uint64_t opening_ = 0;             // of the store that the keys below belong to
  std::vector<PendingDelivery> waiting_;  // to be told next, the last one first
  std::vector<DeliveryKey> told_;         // not noted yet
  SteadyTime next_attempt_;
  std::string last_said_;
  std::vector<std::string> sentences_;
};

}  // namespace traygauge
