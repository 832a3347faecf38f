// A store and a webhook, moved on by hand as the hub's loop does.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/hub/hub_store.hpp"
#include "firmware/webhook/webhook.hpp"
#include "tests/firmware/store/memory_folder.hpp"

namespace traygauge::test {

// What takes minutes in the kitchen takes milliseconds here.
WebhookLimits quick_limits();

class WebhookRig {
 public:
  explicit WebhookRig(const std::string& url, WebhookLimits limits = quick_limits());

  // Throws where the scan is not stored.
  void put(std::uint64_t number);
  void correct(std::uint64_t number, const std::string& food);
  // As after a crash: what was not noted is forgotten.
  void restart();
  void restart(const WebhookConfig& config);

  // One round of the loop; it waits for so long at most.
  void step(std::chrono::milliseconds longest_wait = std::chrono::milliseconds(5));
  // False where it does not become true in time.
  bool run_until(const std::function<bool()>& is_done,
                 std::chrono::milliseconds limit = std::chrono::milliseconds(5000));
  void run_for(std::chrono::milliseconds time);

  HubStore& hub_store() { return *store_; }
  Store& store() { return *store_->store(); }
  const WebhookState& state() const { return webhook_->state(); }
  std::int64_t waiting() const;
  WebhookConfig& config() { return config_; }
  const std::vector<std::string>& log() const { return log_; }
  // Of the calls in which the webhook had the loop and nobody else the processor.
  std::chrono::microseconds longest_call() const { return longest_call_; }

 private:
  MemoryFolder folder_;
  WebhookConfig config_;
  WebhookLimits limits_;
  std::optional<HubStore> store_;
  std::unique_ptr<Webhook> webhook_;
  std::vector<std::string> log_;
  std::chrono::microseconds longest_call_{0};
};

}  // namespace traygauge::test
