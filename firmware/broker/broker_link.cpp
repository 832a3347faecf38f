#include "firmware/broker/broker_link.hpp"

#include <mosquitto.h>
#include <openssl/ssl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <random>
#include <system_error>
#include <utility>

#include "firmware/base/this_machine.hpp"
#include "firmware/broker/broker_problem.hpp"

namespace traygauge {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr int kAtLeastOnce = 1;

int quality_of(Assurance assurance) {
  return assurance == Assurance::at_least_once ? kAtLeastOnce : 0;
}

// An errno that waits at the socket.
int waiting_error(int socket) {
  int error = 0;
  socklen_t size = sizeof(error);
  ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size);
  return error;
}

}  // namespace

// libmosquitto must not be destroyed while it calls back: these only note.
struct BrokerLink::Callbacks {
  static BrokerLink& of(void* self) { return *static_cast<BrokerLink*>(self); }

  static void on_connect(mosquitto* /*client*/, void* self, int refusal) {
    BrokerLink& link = of(self);
    link.refusal_ = refusal;
    link.news_.connected = refusal == 0;
  }
  static void on_subscribed(mosquitto* /*client*/, void* self, int /*id*/, int count, const int* granted) {
    constexpr int kDenied = 0x80;
    if (std::find(granted, granted + count, kDenied) != granted + count) of(self).is_denied_ = true;
  }
  static void on_published(mosquitto* /*client*/, void* self, int id) {
    of(self).news_.acknowledged.push_back(id);
  }
  static void on_message(mosquitto* /*client*/, void* self, const mosquitto_message* message) {
    BrokerLink& link = of(self);
    const auto bytes = static_cast<std::size_t>(message->payloadlen);
    if (bytes > link.params_.limits.max_message_bytes) {
      ++link.news_.dropped;
      return;
    }
    const auto* const payload = static_cast<const char*>(message->payload);
    link.news_.messages.push_back({message->topic, bytes == 0 ? std::string() : std::string(payload, bytes)});
    link.news_bytes_ += bytes;
  }
  static void on_log(mosquitto* /*client*/, void* self, int level, const char* text) {
    if (level == MOSQ_LOG_ERR) of(self).detail_ = text;
  }
};

void BrokerLink::Destroy::operator()(mosquitto* client) const {
  mosquitto_destroy(client);
}

Expected<std::unique_ptr<BrokerLink>> BrokerLink::create(BrokerLinkParams params) {
  static const bool is_ready = mosquitto_lib_init() == MOSQ_ERR_SUCCESS;
  if (!is_ready) return Failure{"libmosquitto cannot be used; install Debian's libmosquitto1"};
  std::string password;
  if (params.config.password_file) {
    Expected<std::string> read = read_broker_password(params.config);
    if (!read.ok()) return Failure{read.failure()};
    password = std::move(*read);
  }
  std::unique_ptr<BrokerTls> tls;
  if (params.config.is_encrypted) {
    Expected<std::unique_ptr<BrokerTls>> created = BrokerTls::create(params.config);
    if (!created.ok()) return Failure{created.failure()};
    tls = std::move(*created);
  }
  return std::unique_ptr<BrokerLink>(new BrokerLink(std::move(params), std::move(password), std::move(tls)));
}

BrokerLink::BrokerLink(BrokerLinkParams params, std::string password, std::unique_ptr<BrokerTls> tls)
    : params_(std::move(params)),
      password_(std::move(password)),
      shown_(params_.config.shown()),
      tls_(std::move(tls)),
      lookup_(params_.config.host),
      back_off_(params_.limits.shortest_wait, params_.limits.longest_wait, std::random_device{}()) {}

BrokerLink::~BrokerLink() = default;

std::string BrokerLink::warning() const {
  const BrokerConfig& config = params_.config;
  if (tls_ != nullptr) return tls_->own_end();
  if (is_this_machine(config.host)) return {};
  return "The way to the broker " + shown_ +
         " is not encrypted: whoever is on it can read and change what is "
         "told, and read the password. Set " +
         config.table + ".tls.";
}

void BrokerLink::add_descriptors(std::vector<pollfd>& descriptors) const {
  if (state_ == State::looking_up) lookup_.add_descriptors(descriptors);
  if (client_ == nullptr) return;
  if (const int socket = mosquitto_socket(client_.get()); socket >= 0)
    descriptors.push_back({socket, events(), 0});
}

std::chrono::milliseconds BrokerLink::timeout() const {
  constexpr std::chrono::milliseconds kBetweenKeepAlives{1000};
  if (state_ == State::connected) return kBetweenKeepAlives;
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline_ - SteadyClock::now());
  return std::max(left, std::chrono::milliseconds(0));
}

BrokerNews BrokerLink::attend() {
  if (state_ == State::waiting && SteadyClock::now() >= deadline_) begin();
  if (state_ == State::looking_up) follow_lookup();
  if (client_ != nullptr) exchange();
  if (state_ != State::waiting && state_ != State::connected && SteadyClock::now() >= deadline_) {
    // What it is told first waits until it takes the connection.
    const bool is_reached = client_ != nullptr && !is_shaking_hands() && !mosquitto_want_write(client_.get());
    fail(shown_ + (is_reached ? " took the connection and did not answer in time."
                              : " could not be reached in time."),
         false);
  }
  if (state_ == State::connected && SteadyClock::now() - connected_at_ > params_.limits.steady_after)
    note_progress();
  news_bytes_ = 0;
  return std::exchange(news_, {});
}

void BrokerLink::begin() {
  deadline_ = SteadyClock::now() + params_.limits.connect_within;
  state_ = State::looking_up;
  if (lookup_.is_running()) return;
  if (const Expected<void> started = lookup_.start(); !started.ok()) fail(started.failure(), false);
}

void BrokerLink::follow_lookup() {
  std::optional<Expected<Addresses>> found = lookup_.take();
  if (!found) return;
  if (!found->ok()) return fail(found->failure(), false);
  addresses_ = std::move(**found);
  connect();
}

// Everything that was published and not acknowledged belongs to the client before and goes with it, so that
// no queue of libmosquitto's grows.
void BrokerLink::connect() {
  state_ = State::connecting;
  refusal_ = 0;
  is_denied_ = false;
  detail_.clear();
  if (tls_ != nullptr) tls_->forget();
  client_.reset(mosquitto_new(params_.client_id.c_str(), !params_.is_remembered, this));
  int result = client_ == nullptr ? MOSQ_ERR_NOMEM : set_up(client_.get());
  if (result == MOSQ_ERR_SUCCESS)
    result =
        mosquitto_connect_async(client_.get(), addresses_[address_ % addresses_.size()].c_str(),
                                params_.config.port, static_cast<int>(params_.limits.keep_alive.count()));
  if (result != MOSQ_ERR_SUCCESS) end(result);
}

int BrokerLink::set_up(mosquitto* client) {
  constexpr int kMoreThanAnyWindow = 1000;
  mosquitto_connect_callback_set(client, &Callbacks::on_connect);
  mosquitto_subscribe_callback_set(client, &Callbacks::on_subscribed);
  mosquitto_publish_callback_set(client, &Callbacks::on_published);
  mosquitto_message_callback_set(client, &Callbacks::on_message);
  mosquitto_log_callback_set(client, &Callbacks::on_log);
  int result = mosquitto_int_option(client, MOSQ_OPT_PROTOCOL_VERSION, MQTT_PROTOCOL_V311);
  const auto next = [&result](int done) {
    if (result == MOSQ_ERR_SUCCESS) result = done;
  };
  next(mosquitto_max_inflight_messages_set(client, kMoreThanAnyWindow));
  next(mosquitto_int_option(client, MOSQ_OPT_TCP_NODELAY, 1));
  if (!params_.will_topic.empty())
    next(mosquitto_will_set(client, params_.will_topic.c_str(), static_cast<int>(params_.will.size()),
                            params_.will.data(), kAtLeastOnce, true));
  const std::string& user = params_.config.user;
  if (!user.empty())
    next(mosquitto_username_pw_set(client, user.c_str(), password_.empty() ? nullptr : password_.c_str()));
  if (tls_ != nullptr) {
    next(mosquitto_void_option(client, MOSQ_OPT_SSL_CTX, tls_->context()));
    next(mosquitto_int_option(client, MOSQ_OPT_SSL_CTX_WITH_DEFAULTS, 0));
  }
  return result;
}

bool BrokerLink::is_shaking_hands() const {
  if (tls_ == nullptr || client_ == nullptr) return false;
  const auto* const ssl = static_cast<const SSL*>(mosquitto_ssl_get(client_.get()));
  return ssl != nullptr && SSL_in_init(ssl) != 0;
}

// While TLS begins, mosquitto_want_write() may stay true though the broker has the word.
std::int16_t BrokerLink::events() const {
  if (is_shaking_hands()) {
    const auto* const ssl = static_cast<const SSL*>(mosquitto_ssl_get(client_.get()));
    return SSL_want(ssl) == SSL_WRITING ? POLLOUT : POLLIN;
  }
  return mosquitto_want_write(client_.get()) ? POLLIN | POLLOUT : POLLIN;
}

void BrokerLink::exchange() {
  const BrokerLimits& limits = params_.limits;
  while (exchange_once()) {
    if (news_.messages.size() >= limits.messages_at_once || news_bytes_ >= limits.bytes_at_once) break;
  }
  if (client_ == nullptr) return;
  if (const int result = mosquitto_loop_misc(client_.get()); result != MOSQ_ERR_SUCCESS) end(result);
}

bool BrokerLink::exchange_once() {
  constexpr int kPackets = 1;
  pollfd ready{mosquitto_socket(client_.get()), events(), 0};
  if (ready.fd < 0) {
    end(MOSQ_ERR_CONN_LOST);
    return false;
  }
  if (::poll(&ready, 1, 0) != 1) return false;
  const bool was_shaking_hands = is_shaking_hands();
  // libmosquitto overlooks a connection that fails in the middle of TLS.
  if (was_shaking_hands && (ready.revents & (POLLERR | POLLHUP)) != 0) {
    errno = waiting_error(ready.fd);
    end(errno != 0 ? MOSQ_ERR_ERRNO : MOSQ_ERR_CONN_LOST);
    return false;
  }
  int result = MOSQ_ERR_SUCCESS;
  errno = 0;
  // While TLS begins, this writes, too.
  if (was_shaking_hands || (ready.revents & ~POLLOUT) != 0)
    result = mosquitto_loop_read(client_.get(), kPackets);
  if (result == MOSQ_ERR_SUCCESS && !was_shaking_hands && (ready.revents & POLLOUT) != 0)
    result = mosquitto_loop_write(client_.get(), kPackets);
  if (result == MOSQ_ERR_SUCCESS && is_denied_) result = MOSQ_ERR_ACL_DENIED;
  if (result != MOSQ_ERR_SUCCESS) {
    end(result);
    return false;
  }
  if (news_.connected && state_ == State::connecting) subscribe();
  return client_ != nullptr;
}

void BrokerLink::subscribe() {
  state_ = State::connected;
  connected_at_ = SteadyClock::now();
  problem_.clear();
  is_refused_ = false;
  for (const std::string& topic : params_.subscriptions) {
    const int result =
        mosquitto_subscribe(client_.get(), nullptr, topic.c_str(), quality_of(params_.subscribed));
    if (result != MOSQ_ERR_SUCCESS) return end(result);
  }
}

Expected<int> BrokerLink::publish(const std::string& topic, const std::string& payload, bool is_retained) {
  return publish(topic, payload, is_retained, Assurance::at_least_once);
}

Expected<void> BrokerLink::publish_once(const std::string& topic, const std::string& payload) {
  const Expected<int> published = publish(topic, payload, false, Assurance::at_most_once);
  if (!published.ok()) return Failure{published.failure()};
  return {};
}

Expected<int> BrokerLink::publish(const std::string& topic, const std::string& payload, bool is_retained,
                                  Assurance assurance) {
  if (!is_connected()) return Failure{problem_};
  int id = 0;
  const int result = mosquitto_publish(client_.get(), &id, topic.c_str(), static_cast<int>(payload.size()),
                                       payload.data(), quality_of(assurance), is_retained);
  if (result == MOSQ_ERR_SUCCESS) return id;
  end(result);
  return Failure{problem_};
}

void BrokerLink::end(int result) {
  BrokerProblem problem;
  problem.result = result;
  problem.system_error = errno;
  problem.refusal = refusal_;
  problem.was_connected = state_ == State::connected;
  problem.detail = detail_;
  if (tls_ != nullptr) {
    problem.distrust = tls_->distrust();
    problem.own_end = tls_->own_end();
  }
  fail(traygauge::describe(problem, params_.config, params_.client_id), is_refusal(problem));
}

void BrokerLink::fail(const std::string& problem, bool is_refused) {
  if (state_ == State::connected) news_.lost = true;
  news_.connected = false;
  problem_ = problem;
  is_refused_ = is_refused;
  state_ = State::waiting;
  ++address_;
  deadline_ = SteadyClock::now() + (is_refused ? back_off_.after_refusal() : back_off_.after_failure());
  client_.reset();
}

}  // namespace traygauge
