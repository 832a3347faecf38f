#include "tests/firmware/fleet/fleet_rig.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "firmware/broker/receipts.hpp"
#include "tests/firmware/store/sample_scan.hpp"
#include "tests/firmware/webhook/call_time.hpp"

namespace traygauge::test {

using std::chrono::milliseconds;
using SteadyClock = std::chrono::steady_clock;

FleetLimits quick_fleet_limits() {
  FleetLimits limits;
  limits.broker.connect_within = milliseconds(500);
  limits.broker.shortest_wait = milliseconds(10);
  limits.broker.longest_wait = milliseconds(200);
  limits.receipt_within = milliseconds(300);
  limits.shortest_wait = milliseconds(20);
  limits.longest_wait = milliseconds(200);
  limits.shortest_postponement = milliseconds(100);
  limits.longest_postponement = milliseconds(400);
  limits.note_within = milliseconds(20);
  limits.health_every = milliseconds(50);
  limits.patience = milliseconds(500);
  return limits;
}

FleetConfig fleet_config(std::uint16_t port) {
  FleetConfig config;
  config.broker.table = "fleet";
  config.broker.host = "127.0.0.1";
  config.broker.port = port;
  config.broker.is_encrypted = false;
  config.name = "kitchen";
  return config;
}

Listener::Listener(const BrokerConfig& broker, const std::string& client_id) {
  BrokerLinkParams params;
  params.config = broker;
  params.client_id = client_id;
  params.subscriptions = {"traygauge/#", "homeassistant/#"};
  params.limits = quick_fleet_limits().broker;
  params.limits.max_message_bytes = 16UL * 1024 * 1024;
  auto link = BrokerLink::create(params);
  if (!link.ok()) throw std::runtime_error(link.failure());
  link_ = std::move(*link);
}

void Listener::step() {
  for (BrokerMessage& message : link_->attend().messages) {
    const bool is_scan = message.topic.ends_with("/scan");
    if (is_scan || message.topic.ends_with("/correction")) {
      const std::string id = nlohmann::json::parse(message.payload).at("id").get<std::string>();
      ids.push_back(id);
      const std::string to = message.topic.substr(0, message.topic.rfind('/')) + "/receipt";
      if (may_receipt_ && may_receipt_(id)) {
        std::span<const std::string> told(&id, 1);
        say(to, make_receipt(told));
      }
    }
    heard.push_back(std::move(message));
  }
}

void Listener::give_receipts(std::function<bool(const std::string&)> may) {
  may_receipt_ = std::move(may);
}

void Listener::say(const std::string& topic, const std::string& payload) {
  static_cast<void>(link_->publish(topic, payload, false));
}

std::string Listener::last(const std::string& topic) const {
  const auto found = std::find_if(heard.rbegin(), heard.rend(),
                                  [&](const BrokerMessage& message) { return message.topic == topic; });
  return found == heard.rend() ? std::string() : found->payload;
}

FleetRig::FleetRig(const FleetConfig& config, FleetLimits limits) : config_(config), limits_(limits) {
  restart();
}

void FleetRig::restart() {
  fleet_.reset();
  store_.reset();
  HubStoreParams params;
  params.options.file = folder_.path() / "results.db";
  params.options.destinations = {kFleetDestination};
  Expected<HubStore> store = HubStore::open(params);
  if (!store.ok()) throw std::runtime_error(store.failure());
  store_.emplace(std::move(*store));
  auto fleet = Fleet::start(
      config_, *store_, [this] { return health; }, limits_);
  if (!fleet.ok()) throw std::runtime_error(fleet.failure());
  fleet_ = std::move(*fleet);
}

void FleetRig::put(std::uint64_t number) {
  const Expected<PutResult> put = store().scans().put(sample_document(number), at(kMorningMs));
  if (!put.ok() || put->outcome != PutOutcome::stored) throw std::runtime_error("not stored");
}

void FleetRig::put_long(std::uint64_t number, std::size_t bytes) {
  auto document = nlohmann::ordered_json::parse(sample_document(number));
  document["message"] = std::string(bytes, 'x');
  const Expected<PutResult> put = store().scans().put(document.dump(), at(kMorningMs));
  if (!put.ok() || put->outcome != PutOutcome::stored) throw std::runtime_error("not stored");
}

void FleetRig::correct(std::uint64_t number, const std::string& food) {
  const auto booked =
      store().corrections().add({"kitchen", number}, RenameItem{2, food}, "chef", "", at(kMorningMs));
  if (!booked.ok() || !booked->refusal.empty()) throw std::runtime_error("not corrected");
}

void FleetRig::step(milliseconds longest_wait) {
  std::vector<pollfd> descriptors;
  fleet_->add_descriptors(descriptors);
  const milliseconds wait = std::min(longest_wait, fleet_->timeout());
  ::poll(descriptors.data(), descriptors.size(), static_cast<int>(wait.count()));
  longest_call_ = std::max(longest_call_, call_time([this] {
                             for (const std::string& sentence : fleet_->attend()) log_ += sentence + "\n";
                           }));
  for (Listener* const listener : listeners_) listener->step();
}

bool FleetRig::run_until(const std::function<bool()>& is_done, milliseconds limit) {
  const auto end = SteadyClock::now() + limit;
  while (!is_done()) {
    if (SteadyClock::now() >= end) return false;
    step();
  }
  return true;
}

int FleetRig::run_for(milliseconds time) {
  int rounds = 0;
  run_until([&rounds] { return ++rounds < 0; }, time);
  return rounds;
}

std::int64_t FleetRig::waiting() const {
  const Expected<std::int64_t> waiting = fleet_->count_waiting();
  if (!waiting.ok()) throw std::runtime_error(waiting.failure());
  return *waiting;
}

}  // namespace traygauge::test
