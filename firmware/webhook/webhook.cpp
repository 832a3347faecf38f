#include "firmware/webhook/webhook.hpp"

#include <algorithm>
#include <random>
#include <span>
#include <utility>

#include "firmware/base/wall_clock.hpp"
#include "firmware/webhook/answer_meaning.hpp"
#include "firmware/webhook/signature.hpp"
#include "firmware/webhook/webhook_message.hpp"
#include "firmware/webhook/webhook_secret.hpp"

namespace traygauge {
namespace {

using SteadyClock = std::chrono::steady_clock;

struct CheckedWebhook {
  WebhookAddress address;
  std::string secret;
};

Expected<CheckedWebhook> examine(const WebhookConfig& config) {
  Expected<WebhookAddress> address = parse_webhook_address(config.address);
  if (!address.ok())
    return Failure{std::string("hub.webhook: expected ") + kExpectedWebhookAddress + ", found " +
                   address.failure()};
  CheckedWebhook checked{std::move(*address), {}};
  if (config.secret) {
    Expected<std::string> secret = read_webhook_secret(*config.secret);
    if (!secret.ok()) return Failure{"hub.webhook_secret: " + secret.failure()};
    checked.secret = std::move(*secret);
  }
  if (config.trusted) {
    const Expected<void> readable = check_certificates(*config.trusted);
    if (!readable.ok()) return Failure{"hub.webhook_ca: " + readable.failure()};
  }
  return checked;
}

}  // namespace

Expected<void> Webhook::check(const WebhookConfig& config) {
  const Expected<CheckedWebhook> checked = examine(config);
  if (!checked.ok()) return Failure{checked.failure()};
  return {};
}

Expected<std::unique_ptr<Webhook>> Webhook::start(const WebhookConfig& config, HubStore& store,
                                                  WebhookLimits limits) {
  Expected<CheckedWebhook> checked = examine(config);
  if (!checked.ok()) return Failure{checked.failure()};
  HttpSenderParams params;
  params.url = checked->address.text;
  params.shown = checked->address.shown;
  params.trusted_file = config.trusted;
  params.connect_within = limits.connect_within;
  params.answer_within = limits.answer_within;
  Expected<HttpSender> sender = HttpSender::create(std::move(params));
  if (!sender.ok()) return Failure{"hub.webhook: " + sender.failure()};
  return std::unique_ptr<Webhook>(new Webhook(std::move(checked->address), std::move(checked->secret),
                                              std::move(*sender), store, limits));
}

Webhook::Webhook(WebhookAddress address, std::string secret, HttpSender sender, HubStore& store,
                 const WebhookLimits& limits)
    : address_(std::move(address)),
      secret_(std::move(secret)),
      sender_(std::move(sender)),
      store_(store),
      limits_(limits),
      back_off_(limits.shortest_wait, limits.longest_wait, std::random_device{}()) {}

std::string Webhook::warning() const {
  if (address_.is_encrypted || address_.is_local) return {};
  return "The webhook " + address_.shown +
         " is not encrypted: whoever is on the way can read and change what is told. Use https.";
}

std::optional<std::chrono::milliseconds> Webhook::timeout() const {
  if (sender_.is_busy()) return sender_.timeout();
  if (!state_.waiting_since || store_.store() == nullptr) return std::nullopt;
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(next_attempt_ - SteadyClock::now());
  return std::max(left, std::chrono::milliseconds(0));
}

std::vector<std::string> Webhook::attend() {
  follow_store();
  if (const std::optional<SendOutcome> outcome = sender_.attend()) finish(*outcome);
  // A look into the store costs some 25 µs: so nobody has to say that something new waits.
  if (!sender_.is_busy() && SteadyClock::now() >= next_attempt_) begin();
  return std::exchange(sentences_, {});
}

bool Webhook::has_waited_long() const {
  return state_.waiting_since && SteadyClock::now() - *state_.waiting_since > limits_.patience;
}

Expected<std::int64_t> Webhook::count_waiting() const {
  Store* const store = store_.store();
  if (store == nullptr) return Failure{store_.problem()};
  const Expected<std::int64_t> stored = store->deliveries().count_pending(kWebhookDestination);
  return stored.ok() ? Expected<std::int64_t>(*stored - static_cast<std::int64_t>(told_.size())) : stored;
}

// Keys of one store mean nothing in another. What is under way goes on to its end, without a note.
void Webhook::follow_store() {
  if (opening_ == store_.openings()) return;
  opening_ = store_.openings();
  waiting_.clear();
  told_.clear();
}

void Webhook::finish(const SendOutcome& outcome) {
  const AnswerMeaning meaning = meaning_of(outcome.status);
  if (meaning != AnswerMeaning::delivered) {
    ++state_.failed_attempts;
    state_.is_refused = meaning == AnswerMeaning::refused;
    const std::string problem =
        outcome.status == 0 ? outcome.problem : describe_answer(address_.shown, outcome.status);
    return wait_after(problem, state_.is_refused ? back_off_.after_refusal() : back_off_.after_failure());
  }
  ++state_.delivered;
  if (!state_.last_failure.empty()) say("The webhook " + address_.shown + " takes what it is told again.");
  last_said_.clear();
  state_.last_failure.clear();
  state_.is_refused = false;
  back_off_.reset();
  if (waiting_.empty()) return;  // of a store that is gone
  told_.push_back(waiting_.back().key);
  waiting_.pop_back();
}

void Webhook::begin() {
  if (store_.store() == nullptr) return;
  Expected<bool> begun = begin_next();
  if (!begun.ok()) wait_after(begun.failure(), back_off_.after_failure());
}

// False where nothing waits.
Expected<bool> Webhook::begin_next() {
  if (waiting_.empty()) {
    if (const Expected<void> noted = note_delivered(); !noted.ok()) return Failure{noted.failure()};
    if (const Expected<void> found = find_waiting(); !found.ok()) return Failure{found.failure()};
    if (waiting_.empty()) {
      state_.waiting_since.reset();
      return false;
    }
    if (!state_.waiting_since) state_.waiting_since = SteadyClock::now();
  }
  Expected<std::optional<WebhookMessage>> message = webhook_message(*store_.store(), waiting_.back());
  if (!message.ok()) return Failure{message.failure()};
  if (!*message) {
    told_.push_back(waiting_.back().key);
    waiting_.pop_back();
    return true;
  }
  std::vector<std::string> headers{"Content-Type: application/json",
                                   "Traygauge-Event-Id: " + (*message)->event_id};
  if (!secret_.empty()) {
    const std::int64_t now_s = read_wall_clock().unix_ms / 1000;
    headers.push_back("Traygauge-Signature: " + webhook_signature(secret_, now_s, (*message)->body));
  }
  if (!sender_.start(std::move((*message)->body), headers)) return Failure{"libcurl starts no transfer."};
  return true;
}

Expected<void> Webhook::note_delivered() {
  if (told_.empty()) return {};
  Expected<void> noted = store_.store()->deliveries().mark_delivered(kWebhookDestination, told_);
  if (noted.ok()) told_.clear();
  return noted;
}

Expected<void> Webhook::find_waiting() {
  Expected<std::vector<PendingDelivery>> due =
      store_.store()->deliveries().due(kWebhookDestination, read_wall_clock().unix_ms, limits_.noted_at_once);
  if (!due.ok()) return Failure{due.failure()};
  waiting_ = std::move(*due);
  std::reverse(waiting_.begin(), waiting_.end());
  return {};
}

void Webhook::wait_after(const std::string& problem, BackOff::Milliseconds wait) {
  next_attempt_ = SteadyClock::now() + wait;
  state_.last_failure = problem;
  if (!state_.waiting_since) state_.waiting_since = SteadyClock::now();
  // What has been told is noted before a long wait.
  if (store_.store() != nullptr) static_cast<void>(note_delivered());
  // The same failure is told once, however often it comes.
  if (problem == last_said_) return;
  last_said_ = problem;
  say("Webhook: " + problem + " Scans and corrections wait and are told when it works again.");
}

void Webhook::say(const std::string& sentence) {
  sentences_.push_back(sentence);
}

}  // namespace traygauge
