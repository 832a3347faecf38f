// What station and hub tell each other over their local socket.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/base/expected.hpp"

namespace traygauge {

enum class MessageType : std::uint8_t {
  // from the station
  hello,  // first on every connection: {"station","program"}
  scan,   // {"id"} and, as bytes, the scan's document, to be stored; answered by stored, set_aside or refused
  state,  // what the station does now: {"state",…}; not answered
  shape,  // {"id"} and, as bytes, what the scan's tray looks like: see compose_shape(); not answered
  picture,  // {"id","keep"} and, as bytes, a JPEG of the scan's tray, where the owner allows it; not answered
  // from the hub
  stored,     // {"id"}: the scan is on disk, now or since an earlier delivery
  set_aside,  // {"id","why"}: kept on disk, but it is no scan that can be booked
  refused,    // {"id","why"}: not on disk; try again later
  next_tray,  // what is known of the next tray: see told_tray_json(); not answered
  // from anybody who may open the socket, without a hello
  ask_drift,  // {"station"}: what its last scans say together; answered by drift
  // from the hub
  drift,  // see told_drift_json()
};
const char* name(MessageType type);

struct Message {
  MessageType type = MessageType::hello;
  std::string text;   // JSON, at most kMaxTextBytes
  std::string bytes;  // at most kMaxBodyBytes; of scan, shape and picture alone

  friend bool operator==(const Message&, const Message&) = default;
};

inline constexpr std::size_t kMaxTextBytes = 256UL * 1024;
inline constexpr std::size_t kMaxBodyBytes = 4UL * 1024 * 1024;

// As it goes over the socket. Larger than the limits is a mistake of the caller.
std::string encode(const Message& message);

// Puts messages together again from what a socket delivers.
class MessageReader {
 public:
  void append(std::string_view received) { received_.append(received); }
  // The next whole message; nothing yet; or why this is no peer of ours. After a failure there is nothing
  // to do but close.
  Expected<std::optional<Message>> next();
  bool holds_part() const { return !received_.empty(); }

 private:
  std::string received_;
};

}  // namespace traygauge
