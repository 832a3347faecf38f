#include "firmware/web/event_streams.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace traygauge {
namespace {

std::string one_line(std::string_view text) {
  std::string line(text);
  std::erase_if(line, [](char c) { return c == '\n' || c == '\r' || c == '\0'; });
  return line;
}

const std::string& heartbeat_text() {
  static const std::string text = event_text({"heartbeat", "{}", {}});
  return text;
}

}  // namespace

struct EventStreams::Registry {
  EventStreamLimits limits;
  std::vector<Stream*> streams;
  std::uint64_t dropped = 0;
};

class EventStreams::Stream final : public ByteStream {
 public:
  explicit Stream(std::shared_ptr<Registry> registry) : registry_(std::move(registry)) {
    registry_->streams.push_back(this);
  }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() override { std::erase(registry_->streams, this); }

  bool is_live() const override { return true; }
  SteadyTime queued_at() const { return queued_at_; }

  // Queues `text`, or closes the stream where it does not fit.
  void queue(std::string_view text) {
    if (is_over_) return;
    if (queued_.size() - at_ + text.size() > registry_->limits.max_queued_bytes) {
      ++registry_->dropped;
      is_over_ = true;
      if (control() != nullptr) control()->cut();
      return;
    }
    queued_.erase(0, std::exchange(at_, 0));
    queued_ += text;
    queued_at_ = std::chrono::steady_clock::now();
    if (control() != nullptr) control()->resume();
  }

  void end() {
    is_over_ = true;
    if (control() != nullptr) control()->resume();
  }

  Piece read(std::span<char> into) override {
    const std::size_t bytes = std::min(into.size(), queued_.size() - at_);
    if (bytes == 0) return {is_over_ ? State::end : State::waiting, 0};
    std::copy_n(queued_.data() + at_, bytes, into.data());
    at_ += bytes;
    return {State::data, bytes};
  }

 private:
  std::shared_ptr<Registry> registry_;
  std::string queued_;
  std::size_t at_ = 0;
  SteadyTime queued_at_;
  bool is_over_ = false;
};

std::string event_text(const WebEvent& event) {
  std::string text = "event: " + one_line(event.name) + "\n";
  if (!event.id.empty()) text += "id: " + one_line(event.id) + "\n";
  // All three line ends that a page would take for one.
  std::string_view rest = event.data;
  for (;;) {
    const std::size_t end = rest.find_first_of("\r\n");
    text += "data: " + std::string(rest.substr(0, end)) + "\n";
    if (end == std::string_view::npos) break;
    rest.remove_prefix(rest.substr(end, 2) == "\r\n" ? end + 2 : end + 1);
  }
  return text + "\n";
}

EventStreams::EventStreams(EventStreamLimits limits, MissedEvents missed)
    : registry_(std::make_shared<Registry>()), missed_(std::move(missed)) {
  registry_->limits = limits;
}

EventStreams::~EventStreams() = default;

HttpResponse EventStreams::open(const HttpRequest& request) {
  HttpResponse response;
  response.content_type = "text/event-stream";
  // Proxies must not hold events back.
  response.headers = {{"Cache-Control", "no-store"}, {"X-Accel-Buffering", "no"}};
  if (request.is_head()) return response;
  if (registry_->streams.size() >= registry_->limits.max_streams) {
    HttpResponse full = error_response(503, "too_many_streams", "Too many pages listen already; close some.");
    full.headers.emplace_back("Retry-After", "30");
    return full;
  }
  auto stream = std::make_unique<Stream>(registry_);
  const std::string* const last_id = request.header("last-event-id");
  std::string missed;
  if (missed_) {
    for (const WebEvent& event : missed_(last_id == nullptr ? "" : *last_id)) missed += event_text(event);
  }
  std::string first = "retry: 2000\n\n" + heartbeat_text();
  const bool fits = first.size() + missed.size() <= registry_->limits.max_queued_bytes;
  stream->queue(first + (fits ? missed : event_text({"missed", "{}", {}})));
  response.body = std::move(stream);
  return response;
}

void EventStreams::broadcast(const WebEvent& event) {
  const std::string text = event_text(event);
  // None is destroyed meanwhile: the server does that in its next run().
  for (Stream* const stream : registry_->streams) stream->queue(text);
}

void EventStreams::attend(SteadyTime now) {
  for (Stream* const stream : registry_->streams) {
    if (now - stream->queued_at() >= registry_->limits.heartbeat) stream->queue(heartbeat_text());
  }
}

void EventStreams::close_all() {
  for (Stream* const stream : registry_->streams) stream->end();
}

std::size_t EventStreams::count() const {
  return registry_->streams.size();
}

std::uint64_t EventStreams::dropped() const {
  return registry_->dropped;
}

}  // namespace traygauge
