#include "firmware/fleet/fleet.hpp"

#include <algorithm>
#include <random>
#include <utility>

#include "firmware/base/wall_clock.hpp"
#include "firmware/broker/receipts.hpp"
#include "firmware/broker/topic.hpp"
#include "firmware/fleet/home_assistant.hpp"
#include "firmware/webhook/webhook_message.hpp"

namespace traygauge {
namespace {

using SteadyClock = std::chrono::steady_clock;
using std::chrono::milliseconds;

Expected<std::unique_ptr<BrokerLink>> make_link(const FleetConfig& config, const BrokerLimits& limits) {
  BrokerLinkParams params;
  params.config = config.broker;
  params.client_id = "traygauge-" + topic_level(config.name);
  params.will_topic = topic_of(config.broker.prefix, config.name, "status");
  params.will = "offline";
  if (config.delivery == FleetDelivery::receipt)
    params.subscriptions.push_back(topic_of(config.broker.prefix, config.name, "receipt"));
  if (config.home_assistant == true) params.subscriptions.push_back(home_assistant_birth_topic(config));
  // A receipt that is lost is asked for by sending again. For some brokers, such as NATS, more is a queue on
  // three disks for each hub.
  params.subscribed = Assurance::at_most_once;
  params.limits = limits;
  params.limits.max_message_bytes = kMaxReceiptBytes;
  return BrokerLink::create(std::move(params));
}

}  // namespace

Expected<void> Fleet::check(const FleetConfig& config) {
  const auto link = make_link(config, {});
  if (!link.ok()) return Failure{link.failure()};
  return {};
}

Expected<std::unique_ptr<Fleet>> Fleet::start(const FleetConfig& config, HubStore& store, HealthText health,
                                              FleetLimits limits) {
  auto link = make_link(config, limits.broker);
  if (!link.ok()) return Failure{link.failure()};
  return std::unique_ptr<Fleet>(new Fleet(config, std::move(*link), store, std::move(health), limits));
}

Fleet::Fleet(FleetConfig config, std::unique_ptr<BrokerLink> link, HubStore& store, HealthText health,
             const FleetLimits& limits)
    : config_(std::move(config)),
      link_(std::move(link)),
      store_(store),
      health_(std::move(health)),
      limits_(limits),
      back_off_(limits.shortest_wait, limits.longest_wait, std::random_device{}()) {}

std::string Fleet::topic(const char* what) const {
  return topic_of(config_.broker.prefix, config_.name, what);
}

bool Fleet::has_room() const {
  if (window_.is_empty()) return true;
  return !is_cautious_ && window_.count() < limits_.window_messages && window_.bytes() < limits_.window_bytes;
}

// Each of these moments passes with attend(): it does what is due, or puts it off.
milliseconds Fleet::timeout() const {
  milliseconds timeout = link_->timeout();
  if (store_.store() == nullptr) return timeout;
  const SteadyTime now = SteadyClock::now();
  const auto within = [&](SteadyTime moment) {
    const auto left = std::chrono::ceil<milliseconds>(std::max(moment, next_work_) - now);
    timeout = std::min(timeout, std::max(left, milliseconds(0)));
  };
  if (!done_.empty()) within(note_at_);
  if (!window_.is_empty()) within(window_.oldest().sent_at + limits_.receipt_within);
  if (is_connected() && has_room() && (!waiting_.empty() || now < next_send_)) within(next_send_);
  return timeout;
}

std::vector<std::string> Fleet::attend() {
  follow_store();
  const BrokerNews news = link_->attend();
  follow_link(news);
  if (store_.store() != nullptr && SteadyClock::now() >= next_work_) {
    if (const Expected<void> worked = work(); !worked.ok()) {
      next_work_ = SteadyClock::now() + limits_.note_within;
      say(worked.failure());
    }
  }
  if (is_connected()) tell_health(false);
  return std::exchange(sentences_, {});
}

// Keys of a store mean nothing in the next one.
void Fleet::follow_store() {
  if (store_.store() != nullptr && opening_ == store_.openings()) return;
  opening_ = store_.store() == nullptr ? 0 : store_.openings();
  waiting_.clear();
  window_.clear();
  done_.clear();
  state_.undeliverable.clear();
}

void Fleet::follow_link(const BrokerNews& news) {
  if (news.lost) note_lost();
  if (news.connected && is_connected()) greet();
  state_.ignored += news.dropped;
  for (const BrokerMessage& message : news.messages) take_message(message);
  if (config_.delivery == FleetDelivery::broker) {
    for (const int number : news.acknowledged) {
      if (const auto entry = window_.take_number(number)) settle(*entry);
    }
  }
  if (!link_->problem().empty()) say(link_->problem());
}

void Fleet::greet() {
  has_receipts_ = false;
  static_cast<void>(link_->publish(topic("status"), "online", true));
  tell_health(true);
  if (config_.home_assistant) tell_home_assistant();
  if (last_said_.empty()) return;
  last_said_.clear();
  sentences_.push_back("Fleet: " + config_.broker.shown() + " is connected again.");
}

void Fleet::tell_home_assistant() {
  for (const RetainedMessage& message : home_assistant_messages(config_))
    static_cast<void>(link_->publish(message.topic, message.payload, true));
}

void Fleet::tell_health(bool is_first) {
  const SteadyTime now = SteadyClock::now();
  if (!is_first && now - health_at_ < limits_.health_every) return;
  health_at_ = now;
  std::string health = health_();
  if (!is_first && health == told_health_) return;
  if (link_->publish(topic("health"), health, true).ok()) told_health_ = std::move(health);
}

void Fleet::take_message(const BrokerMessage& message) {
  if (config_.home_assistant == true && message.topic == home_assistant_birth_topic(config_)) {
    if (message.payload == "online") tell_home_assistant();
    return;
  }
  const auto ids = parse_receipt(message.payload);
  if (!ids || message.topic != topic("receipt")) {
    ++state_.ignored;
    return;
  }
  for (const std::string& id : *ids) {
    if (const auto entry = window_.take_event(id)) settle(*entry);
  }
}

void Fleet::settle(const InFlight& entry) {
  const SteadyTime now = SteadyClock::now();
  if (done_.empty()) note_at_ = now + limits_.note_within;
  done_.push_back(entry.key);
  ++state_.delivered;
  state_.undeliverable.erase(entry.event_id);
  state_.last_failure.clear();
  state_.waiting_since = now;
  last_receipt_ = now;
  is_cautious_ = false;
  has_receipts_ = true;
  back_off_.reset();
  link_->note_progress();
  if (last_said_.empty()) return;
  last_said_.clear();
  sentences_.emplace_back("Fleet: results are delivered again.");
}

// Some brokers end the connection at a message that is too long for them. So after a connection that brought
// no receipt, messages go one at a time until one comes, and the one that ends such a connection, too, is put
// off: the others pass it.
void Fleet::note_lost() {
  if (!window_.is_empty() && !has_receipts_) {
    if (is_cautious_ && store_.store() != nullptr) {
      if (const Expected<void> done = postpone(window_.take_oldest(), link_->problem()); !done.ok())
        say(done.failure());
    }
    is_cautious_ = true;
  }
  window_.clear();
  waiting_.clear();
}

Expected<void> Fleet::work() {
  const bool is_due = done_.size() >= limits_.noted_at_once || SteadyClock::now() >= note_at_;
  if (!done_.empty() && is_due) {
    if (Expected<void> noted = note_delivered(); !noted.ok()) return noted;
  }
  if (Expected<void> looked = look_for_overdue(); !looked.ok()) return looked;
  if (is_connected() && SteadyClock::now() >= next_send_) return fill();
  if (is_connected() || state_.waiting_since) return {};
  Expected<void> found = find_waiting();
  if (!waiting_.empty()) state_.waiting_since = SteadyClock::now();
  waiting_.clear();
  return found;
}

Expected<void> Fleet::note_delivered() {
  Expected<void> noted = store_.store()->deliveries().mark_delivered(kFleetDestination, done_);
  if (noted.ok()) done_.clear();
  return noted;
}

Expected<void> Fleet::look_for_overdue() {
  const SteadyTime now = SteadyClock::now();
  while (!window_.is_empty() && now - window_.oldest().sent_at >= limits_.receipt_within) {
    const std::string who = config_.delivery == FleetDelivery::receipt
                                ? "No collector answered with a receipt behind "
                                : "No acknowledgement came from ";
    const std::string why = who + config_.broker.shown() + " in time.";
    if (last_receipt_ <= window_.oldest().sent_at) {
      pause(why);
      return {};
    }
    if (Expected<void> postponed = postpone(window_.take_oldest(), why); !postponed.ok()) return postponed;
  }
  return {};
}

Expected<void> Fleet::postpone(const InFlight& entry, const std::string& why) {
  ++state_.failed_attempts;
  const int attempts = entry.attempts + 1;
  constexpr int kMostDoublings = 16;
  const milliseconds full =
      std::min(limits_.longest_postponement,
               limits_.shortest_postponement * (1 << std::min(attempts - 1, kMostDoublings)));
  BackOff wait(full, full, std::random_device{}());
  Expected<void> noted = store_.store()->deliveries().mark_failed(
      kFleetDestination, entry.key, read_wall_clock().unix_ms, wait.after_failure(), why);
  if (attempts < limits_.attempts_to_tell) return noted;
  if (state_.undeliverable.emplace(entry.event_id, entry.bytes).second)
    sentences_.push_back("Fleet: " + entry.event_id + " (" + std::to_string(entry.bytes) +
                         " bytes) was sent " + std::to_string(attempts) +
                         " times and is not delivered, though others are. " + why +
                         " It is kept and sent again.");
  return noted;
}

// Nobody answers: everything is sent again later.
void Fleet::pause(const std::string& problem) {
  ++state_.failed_attempts;
  window_.clear();
  waiting_.clear();
  next_send_ = SteadyClock::now() + back_off_.after_failure();
  state_.last_failure = problem;
  say(problem);
}

Expected<void> Fleet::fill() {
  for (std::size_t sent = 0; sent < limits_.sent_at_once && has_room() && is_connected(); ++sent) {
    if (waiting_.empty()) {
      if (Expected<void> found = find_waiting(); !found.ok()) return found;
    }
    if (waiting_.empty()) {
      if (window_.is_empty()) state_.waiting_since.reset();
      return {};
    }
    if (!state_.waiting_since) state_.waiting_since = SteadyClock::now();
    if (Expected<void> began = send_next(); !began.ok()) return began;
  }
  return {};
}

// A look costs some 25 µs: so nobody has to say that something new waits.
Expected<void> Fleet::find_waiting() {
  const std::size_t known = window_.count() + done_.size();
  auto due = store_.store()->deliveries().due(kFleetDestination, read_wall_clock().unix_ms,
                                              known + limits_.window_messages);
  if (!due.ok()) return Failure{due.failure()};
  std::erase_if(*due, [this](const PendingDelivery& delivery) {
    return window_.holds(delivery.key) || std::find(done_.begin(), done_.end(), delivery.key) != done_.end();
  });
  waiting_ = std::move(*due);
  std::reverse(waiting_.begin(), waiting_.end());
  return {};
}

Expected<void> Fleet::send_next() {
  const PendingDelivery delivery = std::move(waiting_.back());
  waiting_.pop_back();
  const Expected<std::optional<WebhookMessage>> message = webhook_message(*store_.store(), delivery);
  if (!message.ok()) return Failure{message.failure()};
  if (!*message) {
    if (done_.empty()) note_at_ = SteadyClock::now() + limits_.note_within;
    done_.push_back(delivery.key);
    return {};
  }
  const std::string& body = (*message)->body;
  const Expected<int> number =
      link_->publish(topic(delivery.correction > 0 ? "correction" : "scan"), body, false);
  InFlight entry{delivery.key, (*message)->event_id, body.size(), delivery.attempts, 0, SteadyClock::now()};
  // It may have ended the connection; attend() hears of it.
  if (number.ok()) entry.number = *number;
  window_.add(std::move(entry));
  ++state_.published;
  return {};
}

// The same is told once, however often it comes.
void Fleet::say(const std::string& problem) {
  if (problem == last_said_) return;
  last_said_ = problem;
  sentences_.push_back("Fleet: " + problem + " Results wait and are delivered when it works again.");
}

}  // namespace traygauge
