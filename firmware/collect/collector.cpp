#include "firmware/collect/collector.hpp"

#include <map>
#include <span>
#include <utility>

#include "firmware/base/wall_clock.hpp"
#include "firmware/broker/receipts.hpp"

namespace traygauge {
namespace {

// More than the longest document with all its corrections.
constexpr std::size_t kMaxEventBytes = 8UL * 1024 * 1024;

}  // namespace

Expected<std::unique_ptr<Collector>> Collector::start(const CollectConfig& config, BrokerLimits limits) {
  BrokerLinkParams params;
  params.config = config.broker;
  params.client_id = "traygauge-" + config.name;
  // What comes while this program is away waits at the broker, as far as it keeps it.
  params.is_remembered = true;
  params.subscriptions = {config.broker.prefix + "/v1/+/scan", config.broker.prefix + "/v1/+/correction"};
  params.limits = limits;
  params.limits.max_message_bytes = kMaxEventBytes;
  Expected<std::unique_ptr<BrokerLink>> link = BrokerLink::create(std::move(params));
  if (!link.ok()) return Failure{link.failure()};
  Expected<std::unique_ptr<CollectedStore>> store = open_collected_store(config.store);
  if (!store.ok()) return Failure{"store: " + store.failure()};
  return std::unique_ptr<Collector>(new Collector(config, std::move(*link), std::move(*store)));
}

Collector::Collector(CollectConfig config, std::unique_ptr<BrokerLink> link,
                     std::unique_ptr<CollectedStore> store)
    : config_(std::move(config)), link_(std::move(link)), store_(std::move(store)) {}

std::vector<std::string> Collector::attend() {
  BrokerNews news = link_->attend();
  counts_.ignored += news.dropped;
  if (news.dropped > 0) say("A message of more than 8 MiB was not stored.");
  if (!news.messages.empty()) take(std::move(news.messages));
  if (!link_->problem().empty()) say(link_->problem());
  if (news.connected && link_->is_connected() && !last_said_.empty()) {
    last_said_.clear();
    sentences_.push_back(config_.broker.shown() + " is connected again.");
  }
  return std::exchange(sentences_, {});
}

void Collector::take(std::vector<BrokerMessage> messages) {
  std::vector<CollectedEvent> events;
  events.reserve(messages.size());
  for (BrokerMessage& message : messages) {
    std::string topic = message.topic;
    if (std::optional<CollectedEvent> event = read_event(config_.broker.prefix, std::move(message))) {
      events.push_back(std::move(*event));
    } else {
      ++counts_.ignored;
      say("A message to " + topic + " is no result and was not stored.");
    }
  }
  if (events.empty()) return;
  const Expected<StoredBatch> batch = store_->put(events, read_wall_clock().unix_ms);
  // Without a receipt hubs send everything again.
  if (!batch.ok()) return say(batch.failure());
  ++counts_.batches;
  counts_.stored += batch->stored;
  counts_.repeated += batch->repeated;
  counts_.twins += batch->twins.size();
  for (const std::string& id : batch->twins)
    say("Two trays are called " + id +
        ": two stations have the same name, or one counts anew. Both are kept.");
  link_->note_progress();
  give_receipts(events);
}

void Collector::give_receipts(const std::vector<CollectedEvent>& events) {
  std::map<std::string, std::vector<std::string>> ids_by_hub;
  for (const CollectedEvent& event : events) ids_by_hub[event.hub].push_back(event.id);
  for (const auto& [hub, ids] : ids_by_hub) {
    for (std::span<const std::string> left(ids); !left.empty();) {
      const std::string receipt = make_receipt(left);
      if (!link_->publish_once(config_.broker.prefix + "/v1/" + hub + "/receipt", receipt).ok()) return;
    }
  }
}

// The same is told once, however often it comes.
void Collector::say(const std::string& problem) {
  if (problem == last_said_) return;
  last_said_ = problem;
  sentences_.push_back(problem);
}

}  // namespace traygauge
