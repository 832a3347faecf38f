// Server-sent events: what happens, told to every page that listens.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/web/http_message.hpp"
#include "firmware/web/request_handler.hpp"

namespace traygauge {

struct WebEvent {
  std::string name;  // what the page listens to
  std::string data;
  std::string id;  // what the page asks from when it connects again; empty: none
};

struct EventStreamLimits {
  // Pages that listen at once; fewer than HttpLimits::max_connections, so that others are still answered.
  std::size_t max_streams = 128;
  // What waits for one page; one that falls further behind is closed, and asks again from where it was.
  std::size_t max_queued_bytes = 32UL * 1024;
  // A page takes the connection for dead when it has heard nothing for twice as long.
  std::chrono::milliseconds heartbeat{10000};
};

// A page that connects gets the event `heartbeat` at once and then whenever `heartbeat` passed without
// another event: an event and no comment, because a page cannot see comments.
class EventStreams {
 public:
  // What came after the event of that id (empty: the page connects for the first time), oldest first.
  using MissedEvents = std::function<std::vector<WebEvent>(std::string_view last_id)>;

  explicit EventStreams(EventStreamLimits limits, MissedEvents missed = {});
  EventStreams(const EventStreams&) = delete;
  EventStreams& operator=(const EventStreams&) = delete;
  ~EventStreams();

  // The answer to a request for events; 503 when max_streams listen. Where more was missed than
  // max_queued_bytes, the page gets the event `missed` instead, and reads everything anew.
  HttpResponse open(const HttpRequest& request);
  void broadcast(const WebEvent& event);
  // Sends heart-beats that are due.
  void attend(SteadyTime now);
  // Pages connect again by themselves, and are asked for their token.
  void close_all();

  std::size_t count() const;
  // Closed because they did not read, since the start.
  std::uint64_t dropped() const;

 private:
  class Stream;
  struct Registry;
  std::shared_ptr<Registry> registry_;  // streams may outlive this
  MissedEvents missed_;
};

// As it is sent; line ends in name and id are left out, in data they begin a new "data:" line.
std::string event_text(const WebEvent& event);

}  // namespace traygauge
