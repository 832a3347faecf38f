// The station's end of the socket to the hub.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/base/expected.hpp"
#include "firmware/handover/local_socket.hpp"
#include "firmware/handover/message.hpp"

namespace traygauge {

struct HubLinkParams {
  std::filesystem::path socket;
  std::string station;
  std::string program_version;
  // A commit to an SD card takes up to half a second; the diner waits for no longer than this.
  Milliseconds answer_timeout{1500};
  // Nobody answers at a path that was tried just now.
  Milliseconds retry_after{500};
};

// What became of a document that was handed over.
enum class HubAnswer : std::uint8_t {
  stored,     // on the hub's disk
  set_aside,  // on the hub's disk, but it cannot be booked; the text says why
  refused,    // the hub answers, but its disk takes nothing; the text says why
  absent,     // nobody answered in time; the text says why
};

struct HubReply {
  HubAnswer answer = HubAnswer::absent;
  std::string text;

  bool is_kept_there() const { return answer == HubAnswer::stored || answer == HubAnswer::set_aside; }
};

// Connects by itself, and again after a failure. Used by one thread.
class HubLink {
 public:
  explicit HubLink(HubLinkParams params) : params_(std::move(params)) {}

  // Hands a scan's document over and waits for the answer about `id`.
  HubReply deliver(std::string_view id, const std::string& document);
  // Tells what is not answered; lost where the hub is away or does not take it in time.
  void tell(const Message& message, Milliseconds longest_wait = Milliseconds::zero());
  // Reads what the hub said on its own account, without waiting; connects where nothing is connected.
  void attend();

  // What the hub told of the next tray since the last call; the last of it.
  std::optional<std::string> take_next_tray() { return std::exchange(next_tray_, std::nullopt); }

  bool is_connected() const { return connection_.is_open(); }
  // Since the last call: a connection was made, and the hub knows nothing of this station yet.
  bool take_is_new() { return std::exchange(is_new_, false); }

 private:
  using SteadyClock = std::chrono::steady_clock;

  Expected<void> connect();
  void disconnect();
  Expected<std::optional<HubReply>> read_reply(std::string_view id, Milliseconds timeout);

  HubLinkParams params_;
  LocalConnection connection_;
  MessageReader reader_;
  std::optional<std::string> next_tray_;
  std::string last_failure_;
  SteadyClock::time_point tried_at_;
  bool was_tried_ = false;
  bool is_new_ = false;
};

}  // namespace traygauge
