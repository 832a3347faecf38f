#include "tests/firmware/webhook/webhook_rig.hpp"

#include <algorithm>
#include <stdexcept>

#include "tests/firmware/store/sample_scan.hpp"
#include "tests/firmware/webhook/call_time.hpp"

namespace traygauge::test {

using std::chrono::milliseconds;
using SteadyClock = std::chrono::steady_clock;

WebhookLimits quick_limits() {
  WebhookLimits limits;
  limits.connect_within = milliseconds(200);
  limits.answer_within = milliseconds(200);
  limits.shortest_wait = milliseconds(4);
  limits.longest_wait = milliseconds(100);
  return limits;
}

WebhookRig::WebhookRig(const std::string& url, WebhookLimits limits) : limits_(limits) {
  config_.address = url;
  restart();
}

void WebhookRig::restart() {
  webhook_.reset();
  store_.reset();
  HubStoreParams params;
  params.options.file = folder_.path() / "results.db";
  params.options.destinations = {kWebhookDestination};
  Expected<HubStore> store = HubStore::open(params);
  if (!store.ok()) throw std::runtime_error(store.failure());
  store_.emplace(std::move(*store));
  Expected<std::unique_ptr<Webhook>> webhook = Webhook::start(config_, *store_, limits_);
  if (!webhook.ok()) throw std::runtime_error(webhook.failure());
  webhook_ = std::move(*webhook);
}

void WebhookRig::restart(const WebhookConfig& config) {
  config_ = config;
  restart();
}

void WebhookRig::put(std::uint64_t number) {
  const Expected<PutResult> put = store().scans().put(sample_document(number), at(kMorningMs));
  if (!put.ok() || put->outcome != PutOutcome::stored) throw std::runtime_error("not stored");
}

void WebhookRig::correct(std::uint64_t number, const std::string& food) {
  const auto booked =
      store().corrections().add({"kitchen", number}, RenameItem{2, food}, "chef", "", at(kMorningMs));
  if (!booked.ok() || !booked->refusal.empty()) throw std::runtime_error("not corrected");
}

void WebhookRig::step(milliseconds longest_wait) {
  std::vector<pollfd> descriptors;
  webhook_->add_descriptors(descriptors);
  const milliseconds wait = std::min(longest_wait, webhook_->timeout().value_or(longest_wait));
  ::poll(descriptors.data(), descriptors.size(), static_cast<int>(wait.count()));
  longest_call_ = std::max(longest_call_, call_time([this] {
                             for (std::string& sentence : webhook_->attend())
                               log_.push_back(std::move(sentence));
                           }));
}

bool WebhookRig::run_until(const std::function<bool()>& is_done, milliseconds limit) {
  const auto end = SteadyClock::now() + limit;
  while (!is_done()) {
    if (SteadyClock::now() >= end) return false;
    step();
  }
  return true;
}

void WebhookRig::run_for(milliseconds time) {
  run_until([] { return false; }, time);
}

std::int64_t WebhookRig::waiting() const {
  const Expected<std::int64_t> waiting = webhook_->count_waiting();
  if (!waiting.ok()) throw std::runtime_error(waiting.failure());
  return *waiting;
}

}  // namespace traygauge::test
