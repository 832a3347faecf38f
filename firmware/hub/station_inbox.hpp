// The hub's end of the sockets to its stations: takes their scans into the store and hears what they do.
#pragma once

#include <poll.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/base/wall_clock.hpp"
#include "firmware/handover/local_socket.hpp"
#include "firmware/handover/message.hpp"
#include "firmware/hub/hub_store.hpp"

namespace traygauge {

struct StationInboxParams {
  // A site has a few stations a hub; each new connection of one replaces its last.
  std::size_t max_connections = 16;
  // Who has connected and says nothing, not even its name, is no station.
  std::chrono::milliseconds hello_within{2000};
};

// What a station said of itself last.
struct LiveStation {
  bool is_connected = false;
  std::string program;  // its version
  std::string state;    // a JSON object; empty before the first
  std::chrono::steady_clock::time_point heard_at;
};

// What others do with what stations say; each may be empty.
struct StationListener {
  std::function<void(const ScanId& id)> on_stored;  // new in the store
  std::function<void(const std::string& station)> on_state;
  std::function<void(const ScanId& id, std::string shape)> on_shape;
  std::function<void(const ScanId& id, std::string jpeg, bool is_kept)> on_picture;
  std::function<void(const std::string& problem)> on_problem;  // a sentence for the log
  // What told_drift_json() writes of a station; without it nobody is told.
  std::function<std::string(const std::string& station)> tell_drift;
};

// Never blocks. Used by one thread.
class StationInbox {
 public:
  StationInbox(LocalListener listener, HubStore& store, StationListener told, StationInboxParams params = {});

  // What the loop waits for.
  void add_descriptors(std::vector<pollfd>& descriptors) const;
  // Takes connections and messages that have come, and answers them.
  void attend();

  // False where the station is not connected or does not read.
  bool tell(const std::string& station, const Message& message);

  // By name; stations that left stay, as not connected.
  const std::map<std::string, LiveStation>& stations() const { return stations_; }

 private:
  using SteadyClock = std::chrono::steady_clock;
  struct Peer {
    LocalConnection connection;
    MessageReader reader;
    std::string station;  // empty before its hello
    SteadyClock::time_point connected_at;
  };

  void accept_new();
  void read(Peer& peer);
  void take_on(Peer& peer, Message message);
  void answer_drift(Peer& peer, const Message& message) const;
  void greet(Peer& peer, const Message& message);
  void keep(Peer& peer, const Message& message);
  Message store(const Peer& peer, const std::string& id, const std::string& document);
  void hear_state(const Peer& peer, Message message);
  void hear_appearance(const Peer& peer, Message message) const;
  static bool send(Peer& peer, const Message& message);
  void forget(Peer& peer);
  void report(const std::string& problem) const;

  LocalListener listener_;
  HubStore& store_;
  StationListener told_;
  StationInboxParams params_;
  std::vector<Peer> peers_;
  std::map<std::string, LiveStation> stations_;
};

}  // namespace traygauge
