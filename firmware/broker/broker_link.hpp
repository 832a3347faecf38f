// A connection to an MQTT broker that comes back by itself, without a thread and without holding its caller.
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
#include "firmware/broker/broker_config.hpp"
#include "firmware/broker/broker_tls.hpp"
#include "firmware/broker/name_lookup.hpp"

struct mosquitto;

namespace traygauge {

struct BrokerLimits {
  std::chrono::milliseconds connect_within{15000};  // from the name to the broker's answer
  std::chrono::milliseconds shortest_wait{1000};    // after a failure; doubled after each further one
  std::chrono::milliseconds longest_wait{5 * 60 * 1000};
  std::chrono::milliseconds steady_after{60 * 1000};  // a connection that lasted so long was no failure
  std::chrono::seconds keep_alive{30};                // silence after which the broker is asked
  std::size_t messages_at_once = 500;                 // of one attend(), and
  std::size_t bytes_at_once = 4UL * 1024 * 1024;      // both may be passed by what came in one piece
  std::size_t max_message_bytes = 64UL * 1024;        // longer ones are dropped and counted
};

// MQTT's quality of service.
enum class Assurance : std::uint8_t { at_most_once, at_least_once };

struct BrokerLinkParams {
  BrokerConfig config;
  std::string client_id;       // another client with the same one ends this one's connection
  bool is_remembered = false;  // the broker keeps subscriptions and messages while this program is away
  std::string will_topic;      // retained; the broker says it when the connection ends. Empty: none
  std::string will;
  std::vector<std::string> subscriptions;
  Assurance subscribed = Assurance::at_least_once;
  BrokerLimits limits;
};

struct BrokerMessage {
  std::string topic;
  std::string payload;
};

// What happened during one attend().
struct BrokerNews {
  bool connected = false;  // and everything before is forgotten
  bool lost = false;
  std::vector<BrokerMessage> messages;
  std::vector<int> acknowledged;  // see publish()
  std::size_t dropped = 0;        // messages that were too long
};

// Used by a loop: add_descriptors(), timeout(), attend().
class BrokerLink {
 public:
  // The failure names key and file. Nothing is connected yet.
  static Expected<std::unique_ptr<BrokerLink>> create(BrokerLinkParams params);
  BrokerLink(const BrokerLink&) = delete;
  BrokerLink& operator=(const BrokerLink&) = delete;
  // Ends the connection as a crash does, so that the broker says the will.
  ~BrokerLink();

  void add_descriptors(std::vector<pollfd>& descriptors) const;
  // Until attend() has to be called at the latest.
  std::chrono::milliseconds timeout() const;
  BrokerNews attend();

  bool is_connected() const { return state_ == State::connected; }
  // Why there is no connection; empty: there is one, or nothing failed yet.
  const std::string& problem() const { return problem_; }
  // Only a change of the configuration or at the broker helps.
  bool is_refused() const { return is_refused_; }
  // What has to be known of the configuration, for the log; empty: nothing.
  std::string warning() const;

  // At least once, as long as the connection lasts. The number comes back in BrokerNews::acknowledged.
  Expected<int> publish(const std::string& topic, const std::string& payload, bool is_retained);
  // At most once, for what somebody asks for again where it is lost.
  Expected<void> publish_once(const std::string& topic, const std::string& payload);
  // The connection is of use: the next failure is the first one again.
  void note_progress() { back_off_.reset(); }

 private:
  using SteadyTime = std::chrono::steady_clock::time_point;
  enum class State : std::uint8_t { waiting, looking_up, connecting, connected };
  struct Callbacks;
  struct Destroy {
    void operator()(mosquitto* client) const;
  };

  BrokerLink(BrokerLinkParams params, std::string password, std::unique_ptr<BrokerTls> tls);
  void begin();
  void follow_lookup();
  void connect();
  int set_up(mosquitto* client);
  void exchange();
  // False: nothing more is ready, or the connection has ended.
  bool exchange_once();
  bool is_shaking_hands() const;
  std::int16_t events() const;
  void subscribe();
  Expected<int> publish(const std::string& topic, const std::string& payload, bool is_retained,
                        Assurance assurance);
  void end(int result);
  void fail(const std::string& problem, bool is_refused);

  BrokerLinkParams params_;
  std::string password_;
  std::string shown_;
  std::unique_ptr<BrokerTls> tls_;  // null: not encrypted
  NameLookup lookup_;
  BackOff back_off_;
  State state_ = State::waiting;
  SteadyTime deadline_;  // of waiting, or of getting connected
  SteadyTime connected_at_;
  Addresses addresses_;
  std::size_t address_ = 0;  // the one that is tried
  std::string problem_;
  bool is_refused_ = false;
  int refusal_ = 0;         // the broker's code; 0: none
  bool is_denied_ = false;  // a subscription
  std::string detail_;      // libmosquitto's last complaint
  BrokerNews news_;
  std::size_t news_bytes_ = 0;
  std::unique_ptr<mosquitto, Destroy> client_;
};

// What the file of a password holds. The failure names the key and the file, never the content.
Expected<std::string> read_broker_password(const BrokerConfig& config);

}  // namespace traygauge
