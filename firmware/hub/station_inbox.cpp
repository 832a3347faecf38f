#include "firmware/hub/station_inbox.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "firmware/base/json_reading.hpp"
#include "firmware/base/scan_id.hpp"
#include "firmware/store/scan_document.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

Json parsed(const std::string& text) {
  return Json::parse(text, nullptr, false);
}

Message answer(MessageType type, const std::string& id, const std::string& why = {}) {
  const Json json = {{"id", id}, {"why", why}};
  return {type, json.dump(-1, ' ', false, Json::error_handler_t::replace), {}};
}

}  // namespace

StationInbox::StationInbox(LocalListener listener, HubStore& store, StationListener told,
                           StationInboxParams params)
    : listener_(std::move(listener)), store_(store), told_(std::move(told)), params_(params) {}

void StationInbox::add_descriptors(std::vector<pollfd>& descriptors) const {
  descriptors.push_back({listener_.descriptor(), POLLIN, 0});
  for (const Peer& peer : peers_) descriptors.push_back({peer.connection.descriptor(), POLLIN, 0});
}

void StationInbox::attend() {
  accept_new();
  for (Peer& peer : peers_) read(peer);
  const auto now = SteadyClock::now();
  for (Peer& peer : peers_) {
    if (peer.station.empty() && now - peer.connected_at > params_.hello_within) peer.connection.close();
  }
  for (Peer& peer : peers_) {
    if (!peer.connection.is_open()) forget(peer);
  }
  std::erase_if(peers_, [](const Peer& peer) { return !peer.connection.is_open(); });
}

void StationInbox::accept_new() {
  for (;;) {
    Expected<LocalConnection> accepted = listener_.accept();
    if (!accepted.ok()) report(accepted.failure());
    if (!accepted.ok() || !accepted->is_open()) return;
    // One too many is closed at once; who was here first stays.
    if (peers_.size() >= params_.max_connections) continue;
    peers_.push_back({std::move(*accepted), {}, {}, SteadyClock::now()});
  }
}

void StationInbox::read(Peer& peer) {
  const Expected<std::string> received = peer.connection.receive_some(Milliseconds::zero());
  if (!received.ok()) return peer.connection.close();
  peer.reader.append(*received);
  while (peer.connection.is_open()) {
    Expected<std::optional<Message>> next = peer.reader.next();
    if (!next.ok()) {
      report("a station's socket: " + next.failure() + "; the connection is closed");
      return peer.connection.close();
    }
    if (!*next) return;
    take_on(peer, std::move(**next));
  }
}

void StationInbox::take_on(Peer& peer, Message message) {
  if (message.type == MessageType::hello) return greet(peer, message);
  if (message.type == MessageType::ask_drift) return answer_drift(peer, message);
  if (peer.station.empty()) {
    report(std::string("a station's socket: expected its name first, found ") + name(message.type) +
           "; the connection is closed");
    return peer.connection.close();
  }
  switch (message.type) {
    case MessageType::scan:
      return keep(peer, message);
    case MessageType::state:
      return hear_state(peer, std::move(message));
    case MessageType::shape:
    case MessageType::picture:
      return hear_appearance(peer, std::move(message));
    default:
      report("station " + peer.station + " sent " + name(message.type) + ", which a hub says");
  }
}

// Not only to stations: who asks may be a person at the command line, while the station runs.
void StationInbox::answer_drift(Peer& peer, const Message& message) const {
  if (told_.tell_drift)
    send(peer, {MessageType::drift, told_.tell_drift(json_text(parsed(message.text), "station")), {}});
}

void StationInbox::greet(Peer& peer, const Message& message) {
  const Json hello = parsed(message.text);
  const std::string station = json_text(hello, "station");
  if (!is_station_name(station)) {
    report("a station's socket: expected a name of a-z, 0-9 and '-' in its hello; the connection is closed");
    return peer.connection.close();
  }
  if (!peer.station.empty() && peer.station != station) {
    report("station " + peer.station + " said that it is " + station +
           ": a connection is one station's; it is closed");
    return peer.connection.close();
  }
  // A station that was killed comes back before its old connection is seen to be dead.
  for (Peer& other : peers_) {
    if (&other != &peer && other.station == station) {
      other.station.clear();
      other.connection.close();
    }
  }
  peer.station = station;
  LiveStation& live = stations_[station];
  live.is_connected = true;
  live.program = json_text(hello, "program");
  live.heard_at = SteadyClock::now();
  if (told_.on_state) told_.on_state(station);
}

void StationInbox::keep(Peer& peer, const Message& message) {
  const std::string id = json_text(parsed(message.text), "id");
  send(peer, store(peer, id, message.bytes));
}

Message StationInbox::store(const Peer& peer, const std::string& id, const std::string& document) {
  Store* const store = store_.store();
  if (store == nullptr) return answer(MessageType::refused, id, store_.problem());
  const WallTime now = read_wall_clock();
  const Expected<ScanDocument> read = read_scan_document(document);
  if (read.ok() && read->id.station != peer.station) {
    // It would take a number of the other station, whose own scan could then not be stored.
    const std::string why = "station " + peer.station + " handed over a scan of " + read->id.station;
    const Expected<void> kept = store->scans().set_aside(document, why, now);
    report(kept.ok() ? why + "; it is set aside" : kept.failure());
    return kept.ok() ? answer(MessageType::set_aside, id, why)
                     : answer(MessageType::refused, id, kept.failure());
  }
  const Expected<PutResult> put = store->scans().put(document, now);
  if (!put.ok()) {
    report(put.failure());
    return answer(MessageType::refused, id, put.failure());
  }
  if (put->outcome == PutOutcome::set_aside) {
    report("a scan of station " + peer.station + " is set aside: " + put->why);
    return answer(MessageType::set_aside, id, put->why);
  }
  if (put->outcome == PutOutcome::stored && told_.on_stored) told_.on_stored(read->id);
  return answer(MessageType::stored, id);
}

void StationInbox::hear_state(const Peer& peer, Message message) {
  if (!parsed(message.text).is_object())
    return report("station " + peer.station + ": expected its state as a JSON object, found something else");
  LiveStation& live = stations_[peer.station];
  live.state = std::move(message.text);
  live.heard_at = SteadyClock::now();
  if (told_.on_state) told_.on_state(peer.station);
}

void StationInbox::hear_appearance(const Peer& peer, Message message) const {
  const Json text = parsed(message.text);
  const std::optional<ScanId> id = parse_scan_id(json_text(text, "id"));
  if (!id || id->station != peer.station)
    return report("station " + peer.station + ": expected the " + name(message.type) +
                  " of a scan of its own, found another");
  // Only a picture that says so is kept.
  const bool is_kept = text.contains("keep") && text["keep"] == true;
  if (message.type == MessageType::shape && told_.on_shape)
    told_.on_shape(*id, std::move(message.bytes));
  else if (message.type == MessageType::picture && told_.on_picture)
    told_.on_picture(*id, std::move(message.bytes), is_kept);
}

bool StationInbox::tell(const std::string& station, const Message& message) {
  const auto peer = std::find_if(peers_.begin(), peers_.end(),
                                 [&station](const Peer& one) { return one.station == station; });
  return peer != peers_.end() && send(*peer, message);
}

// What a hub says is short: a station that does not read it hangs, and asks again once it lives.
bool StationInbox::send(Peer& peer, const Message& message) {
  const bool is_sent = peer.connection.send_all(encode(message), Milliseconds::zero()).ok();
  if (!is_sent) peer.connection.close();
  return is_sent;
}

void StationInbox::forget(Peer& peer) {
  if (peer.station.empty()) return;
  stations_[peer.station].is_connected = false;
  if (told_.on_state) told_.on_state(peer.station);
}

void StationInbox::report(const std::string& problem) const {
  if (told_.on_problem) told_.on_problem(problem);
}

}  // namespace traygauge
