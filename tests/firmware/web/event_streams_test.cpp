#include "firmware/web/event_streams.hpp"

#include <gtest/gtest.h>

#include <array>

namespace traygauge::test {
namespace {

// Stands in for the server's side of a connection.
struct Control final : StreamControl {
  void resume() override { ++resumed; }
  void cut() override { is_cut = true; }
  int resumed = 0;
  bool is_cut = false;
};

struct Listening {
  explicit Listening(EventStreams& events, NamedTexts headers = {}) {
    HttpRequest request;
    request.method = "GET";
    request.headers = std::move(headers);
    HttpResponse response = events.open(request);
    status = response.status;
    if (auto* const body = std::get_if<std::unique_ptr<ByteStream>>(&response.body))
      stream = std::move(*body);
    if (stream) stream->attach(control);
  }
  std::string read() {
    std::string text;
    std::array<char, 1000> block{};
    for (;;) {
      const auto piece = stream->read(block);
      last = piece.state;
      if (piece.state != ByteStream::State::data) return text;
      text.append(block.data(), piece.bytes);
    }
  }

  int status = 0;
  Control control;
  std::unique_ptr<ByteStream> stream;
  ByteStream::State last = ByteStream::State::data;
};

TEST(EventText, HasALineForEachOfTheData) {
  EXPECT_EQ(event_text({"scan", "{}", "7"}), "event: scan\nid: 7\ndata: {}\n\n");
  EXPECT_EQ(event_text({"a", "x\ny\r\nz\rw\n", ""}),
            "event: a\ndata: x\ndata: y\ndata: z\ndata: w\ndata: \n\n");
  EXPECT_EQ(event_text({"a\ndata: forged", "x", "1\r\n\r\nevent: forged"}),
            "event: adata: forged\nid: 1event: forged\ndata: x\n\n");
}

TEST(EventStreamsOfPages, ToldToAll) {
  EventStreams events{EventStreamLimits{}};
  Listening first(events), second(events);
  EXPECT_EQ(first.read(), "retry: 2000\n\nevent: heartbeat\ndata: {}\n\n");
  EXPECT_EQ(first.last, ByteStream::State::waiting);
  second.read();
  events.broadcast({"scan", "1", "a-1"});
  EXPECT_EQ(first.control.resumed, 1);
  EXPECT_EQ(first.read(), "event: scan\nid: a-1\ndata: 1\n\n");
  EXPECT_EQ(second.read(), "event: scan\nid: a-1\ndata: 1\n\n");
  EXPECT_EQ(events.count(), 2U);
  second.stream.reset();
  EXPECT_EQ(events.count(), 1U);
}

TEST(EventStreamsOfPages, BeatWhileNothingHappens) {
  EventStreams events{EventStreamLimits{}};
  Listening page(events);
  page.read();
  const SteadyTime now = std::chrono::steady_clock::now();
  events.attend(now + std::chrono::seconds(9));
  EXPECT_EQ(page.read(), "");
  events.attend(now + std::chrono::seconds(11));
  EXPECT_EQ(page.read(), "event: heartbeat\ndata: {}\n\n");
}

TEST(EventStreamsOfPages, BeginWithWhatWasMissed) {
  std::string asked = "nothing";
  int missed = 2;
  EventStreams events(EventStreamLimits{}, [&](std::string_view last_id) {
    asked = last_id;
    return std::vector<WebEvent>(static_cast<std::size_t>(missed),
                                 WebEvent{"scan", std::string(900, 'x'), "a-8"});
  });
  Listening fresh(events);
  EXPECT_EQ(asked, "");
  Listening again(events, {{"last-event-id", "a-7"}});
  EXPECT_EQ(asked, "a-7");
  const std::string text = again.read();
  EXPECT_NE(text.find("id: a-8"), text.rfind("id: a-8"));
  missed = 1000;
  Listening long_away(events);
  EXPECT_NE(long_away.read().find("event: missed\n"), std::string::npos) << "too much to tell";
  EXPECT_EQ(long_away.last, ByteStream::State::waiting);
}

TEST(EventStreamsOfPages, AreBounded) {
  EventStreams events{{2, 1000, std::chrono::seconds(10)}};
  Listening first(events), second(events), third(events);
  EXPECT_EQ(second.status, 200);
  EXPECT_EQ(third.status, 503);
  first.read();
  for (int i = 0; i < 20; ++i) {
    events.broadcast({"scan", std::string(80, 'x'), ""});
    first.read();
  }
  EXPECT_FALSE(first.control.is_cut) << "who reads is told everything";
  EXPECT_TRUE(second.control.is_cut) << "who does not is closed";
  EXPECT_EQ(events.dropped(), 1U);
  EXPECT_LE(second.read().size(), 1000U);
}

TEST(EventStreamsOfPages, EndWhenTheyAreClosed) {
  auto events = std::make_unique<EventStreams>(EventStreamLimits{});
  Listening page(*events);
  page.read();
  events->close_all();
  EXPECT_EQ(page.control.resumed, 1);
  EXPECT_EQ(page.read(), "");
  EXPECT_EQ(page.last, ByteStream::State::end);
  events.reset();
  page.stream.reset();  // may be destroyed later than what made it
}

}  // namespace
}  // namespace traygauge::test
