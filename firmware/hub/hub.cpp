#include "firmware/hub/hub.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "firmware/handover/told_drift.hpp"

namespace traygauge {

Expected<std::unique_ptr<Hub>> Hub::start(HubParams params, HubLog log) {
  // The socket first: who has it is the only hub, and waits for no other one's file.
  Expected<LocalListener> listener = LocalListener::open(params.socket);
  if (!listener.ok()) return Failure{listener.failure()};
  if (params.webhook) params.store.options.destinations.emplace_back(kWebhookDestination);
  if (params.fleet) params.store.options.destinations.emplace_back(kFleetDestination);
  Expected<HubStore> store = HubStore::open(params.store);
  if (!store.ok()) return Failure{store.failure()};
  for (const std::string& notice : store->notices()) log(notice);
  std::unique_ptr<Hub> hub(new Hub(std::move(*store), std::move(*listener), params, std::move(log)));
  hub->follow_drift();
  if (const auto started = hub->start_webhook(params.webhook, params.webhook_limits); !started.ok())
    return Failure{started.failure()};
  if (const auto started = hub->start_fleet(params.fleet, params.fleet_limits); !started.ok())
    return Failure{started.failure()};
  if (params.web.config.listen.empty()) return hub;
  Expected<std::unique_ptr<HubWeb>> web =
      HubWeb::start(params.web, {hub->store_, hub->inbox_, hub->drift_, hub->shapes_, hub->pictures_});
  if (!web.ok()) return Failure{web.failure()};
  hub->web_ = std::move(*web);
  if (hub->webhook_ != nullptr) hub->web_->show_webhook(*hub->webhook_);
  if (hub->fleet_ != nullptr) hub->web_->show_fleet(*hub->fleet_);
  return hub;
}

Hub::Hub(HubStore store, LocalListener listener, const HubParams& params, HubLog log)
    : log_(std::move(log)),
      configuration_problem_(params.web.configuration_problem),
      store_(std::move(store)),
      pictures_(params.pictures),
      inbox_(std::move(listener), store_, listener_for_inbox(), params.inbox) {}

void Hub::run(const std::atomic<bool>& stop, const std::function<void()>& after_step) {
  // A signal interrupts the wait, but for one that comes just before it.
  constexpr std::chrono::milliseconds kLongestWait{500};
  while (!stop) {
    step(kLongestWait);
    if (after_step) after_step();
  }
}

void Hub::step(std::chrono::milliseconds longest_wait) {
  std::vector<pollfd> descriptors;
  inbox_.add_descriptors(descriptors);
  if (web_ != nullptr) {
    descriptors.push_back({web_->descriptor(), POLLIN, 0});
    if (const auto timeout = web_->timeout()) longest_wait = std::min(longest_wait, *timeout);
  }
  if (webhook_ != nullptr) {
    webhook_->add_descriptors(descriptors);
    if (const auto timeout = webhook_->timeout()) longest_wait = std::min(longest_wait, *timeout);
  }
  if (fleet_ != nullptr) {
    fleet_->add_descriptors(descriptors);
    longest_wait = std::min(longest_wait, fleet_->timeout());
  }
  ::poll(descriptors.data(), descriptors.size(), static_cast<int>(longest_wait.count()));
  inbox_.attend();
  if (web_ != nullptr) web_->run();
  // After the others, who may have stored what it tells at once.
  if (webhook_ != nullptr) {
    for (const std::string& sentence : webhook_->attend()) log_(sentence);
  }
  if (fleet_ != nullptr) {
    for (const std::string& sentence : fleet_->attend()) log_(sentence);
  }
  for (const std::string& sentence : store_.tend(std::chrono::steady_clock::now())) log_(sentence);
  follow_drift();
  tidy_pictures();
}

// Once an hour, as the store's retention runs: a picture goes with its scan. A scan that cannot be looked for
// keeps its picture.
void Hub::tidy_pictures() {
  constexpr std::chrono::hours kEvery{1};
  const auto now = std::chrono::steady_clock::now();
  if (now - tidied_at_ < kEvery || store_.store() == nullptr) return;
  tidied_at_ = now;
  pictures_.tidy([this](const ScanId& id) {
    const Expected<std::optional<StoredScan>> scan = store_.store()->scans().find(id);
    return !scan.ok() || scan->has_value();
  });
}

StationListener Hub::listener_for_inbox() {
  StationListener listener;
  listener.on_stored = [this](const ScanId& id) {
    last_problem_.clear();
    drift_.note(id);
    if (web_ != nullptr) web_->tell_scan(id);
  };
  listener.on_state = [this](const std::string& station) {
    if (web_ != nullptr) web_->tell_station(station);
  };
  listener.on_shape = [this](const ScanId& id, std::string shape) {
    if (const Expected<void> put = shapes_.put(id, std::move(shape)); !put.ok())
      return log_problem(put.failure());
    if (web_ != nullptr) web_->tell_shape(id);
  };
  listener.on_picture = [this](const ScanId& id, std::string jpeg, bool is_kept) {
    const Expected<void> put = is_kept ? pictures_.keep(id, jpeg) : pictures_.show(id, std::move(jpeg));
    if (!put.ok()) log_problem(put.failure());
  };
  listener.tell_drift = [this](const std::string& station) { return drift_of(station); };
  listener.on_problem = [this](const std::string& problem) { log_problem(problem); };
  return listener;
}

// Where the key is gone, what waits for the receiver goes, too: it would keep old scans from being deleted.
Expected<void> Hub::abandon(const char* destination, const char* key) {
  const Expected<std::int64_t> gone = store_.store()->deliveries().abandon(destination);
  if (!gone.ok()) return Failure{gone.failure()};
  if (*gone > 0)
    log_(std::string("No ") + key + " is configured any more: " + std::to_string(*gone) +
         " scans and corrections that waited for it will not be told.");
  return {};
}

Expected<void> Hub::start_webhook(const std::optional<WebhookConfig>& config, const WebhookLimits& limits) {
  if (!config) return abandon(kWebhookDestination, "webhook");
  Expected<std::unique_ptr<Webhook>> webhook = Webhook::start(*config, store_, limits);
  if (!webhook.ok()) return Failure{webhook.failure()};
  webhook_ = std::move(*webhook);
  if (const std::string warning = webhook_->warning(); !warning.empty()) log_(warning);
  return {};
}

Expected<void> Hub::start_fleet(const std::optional<FleetConfig>& config, const FleetLimits& limits) {
  if (!config) return abandon(kFleetDestination, "fleet");
  const auto health = [this] { return health_json(examine_health(health_subjects())); };
  Expected<std::unique_ptr<Fleet>> fleet = Fleet::start(*config, store_, health, limits);
  if (!fleet.ok()) return Failure{fleet.failure()};
  fleet_ = std::move(*fleet);
  if (const std::string warning = fleet_->warning(); !warning.empty()) log_(warning);
  return {};
}

HealthSubjects Hub::health_subjects() const {
  return {store_, inbox_, drift_, webhook_.get(), fleet_.get(), configuration_problem_, read_wall_clock()};
}

std::string Hub::drift_of(const std::string& name) const {
  std::vector<ToldTrend> told;
  for (const StationTrends& station : drift_.trends()) {
    if (station.station != name) continue;
    for (const CheckTrend& trend : station.trends) {
      told.push_back({traygauge::name(trend.check), trend.last.value, trend.last.sigma, trend.last.count,
                      trend.drifts ? drift_sentence(trend) : std::string()});
    }
  }
  return told_drift_json(told);
}

void Hub::follow_drift() {
  if (const auto followed = drift_.follow(std::chrono::steady_clock::now()); !followed.ok())
    log_problem(followed.failure());
}

// A station asks again every few seconds: the same answer is told once.
void Hub::log_problem(const std::string& problem) {
  if (problem != last_problem_) log_(problem);
  last_problem_ = problem;
}

}  // namespace traygauge
