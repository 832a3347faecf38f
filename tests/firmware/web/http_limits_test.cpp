// Clients that take too much, or too long.
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "firmware/web/connection_limits.hpp"
#include "firmware/web/http_server.hpp"
#include "tests/firmware/web/echo_handler.hpp"
#include "tests/firmware/web/server_thread.hpp"
#include "tests/firmware/web/web_client.hpp"
#include "tests/support/becomes_true.hpp"

namespace traygauge::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Clock = std::chrono::steady_clock;

#if defined(TRAYGAUGE_ADDRESS_SANITIZER)
constexpr bool kMemoryIsMeasured = false;  // freed memory is kept aside
#else
constexpr bool kMemoryIsMeasured = true;
#endif

HttpLimits short_times() {
  HttpLimits limits;
  limits.max_head_time = milliseconds(300);
  limits.max_body_time = milliseconds(300);
  limits.max_stall = milliseconds(300);
  limits.min_bytes_per_s = 1000000;
  limits.sweep_interval = milliseconds(20);
  return limits;
}

double resident_kib() {
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;) {
    double kib = 0;
    if (word == "VmRSS:" && file >> kib) return kib;
  }
  return 0;
}

// Sends byte by byte until the server has had enough; how long that took.
milliseconds time_of_dripping(WebClient& client, std::string_view bytes) {
  const auto begin = Clock::now();
  while (Clock::now() - begin < seconds(5)) {
    for (const char c : bytes) {
      if (!client.send({&c, 1}) || client.is_closed_within(milliseconds(10)))
        return std::chrono::duration_cast<milliseconds>(Clock::now() - begin);
    }
  }
  return seconds(5);
}

TEST(WebLimits, ClosesWhoDripsTheHead) {
  EchoHandler handler;
  ServerThread server(handler, short_times());
  WebClient slow(server.port());
  ASSERT_TRUE(slow.send("GET / HTTP/1.1\r\nHost: localhost\r\n"));
  const auto took = time_of_dripping(slow, "X-A: b\r\n");
  EXPECT_GE(took, milliseconds(250));
  EXPECT_LT(took, milliseconds(2000));
  EXPECT_EQ(server.counts().overdue, 1U);
  EXPECT_EQ(handler.answered, 0);
}

TEST(WebLimits, ClosesWhoDripsTheBodyOrSaysNothing) {
  EchoHandler handler(64UL * 1024);
  ServerThread server(handler, short_times());
  WebClient silent(server.port());
  WebClient slow(server.port());
  ASSERT_TRUE(slow.send("POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 60000\r\n\r\n"));
  EXPECT_LT(time_of_dripping(slow, "x"), milliseconds(2000));
  EXPECT_TRUE(silent.is_closed_within(seconds(2)));
  WebClient idle(server.port());
  ASSERT_EQ(idle.ask("GET", "/")->status, 200);
  EXPECT_TRUE(idle.is_closed_within(seconds(2))) << "after an answer the time begins anew";
  EXPECT_EQ(server.counts().overdue, 3U);
}

TEST(WebLimits, ClosesWhoDoesNotReadTheAnswer) {
  EchoHandler handler;
  ServerThread server(handler, short_times());
  std::uint64_t overdue = 0;
  for (const char* const target : {"/length/30000000", "/pieces/30000"}) {
    WebClient deaf(server.port());
    ASSERT_TRUE(deaf.send("GET " + std::string(target) + " HTTP/1.1\r\nHost: localhost\r\n\r\n"));
    ++overdue;
    EXPECT_TRUE(becomes_true([&] { return server.counts().overdue == overdue; })) << target;
    EXPECT_TRUE(becomes_true([&] { return server.counts().open == 0; })) << target;
  }
}

// Never silent for long, but far below the least rate.
TEST(WebLimits, ClosesWhoReadsTooSlowly) {
  EchoHandler handler;
  ServerThread server(handler, short_times());
  WebClient slow(server.port());
  ASSERT_TRUE(slow.send("GET /length/30000000 HTTP/1.1\r\nHost: localhost\r\n\r\n"));
  const auto reads_and_is_closed = [&] {
    std::this_thread::sleep_for(milliseconds(90));
    std::array<char, 50000> block{};
    ::recv(slow.descriptor(), block.data(), block.size(), MSG_DONTWAIT);
    return server.counts().overdue == 1;
  };
  EXPECT_TRUE(becomes_true(reads_and_is_closed));
}

TEST(WebLimits, ServesOthersMeanwhile) {
  EchoHandler handler;
  ServerThread server(handler);
  WebClient deaf(server.port());
  ASSERT_TRUE(deaf.send("GET /length/30000000 HTTP/1.1\r\nHost: localhost\r\n\r\n"));
  WebClient slow(server.port());
  ASSERT_TRUE(slow.send("POST / HTTP/1.1\r\nHost:"));
  const auto begin = Clock::now();
  for (int i = 0; i < 100; ++i) ASSERT_EQ(WebClient(server.port()).ask("GET", "/")->status, 200);
  EXPECT_LT(Clock::now() - begin, seconds(2));
}

TEST(WebLimits, OnePeerHasSoManyConnections) {
  HttpLimits limits;
  limits.max_connections_per_peer = 3;
  limits.uncounted_peers.clear();
  EchoHandler handler;
  ServerThread server(handler, limits);
  std::vector<WebClient> clients;
  for (int i = 0; i < 3; ++i) {
    clients.emplace_back(server.port());
    ASSERT_EQ(clients.back().ask("GET", "/")->status, 200);
  }
  EXPECT_TRUE(WebClient(server.port()).is_closed_within(seconds(2)));
  EXPECT_EQ(server.counts().refused_peers, 1U);
  clients.pop_back();
  EXPECT_TRUE(becomes_true([&] { return server.counts().open == 2; }));
  EXPECT_EQ(WebClient(server.port()).ask("GET", "/")->status, 200);
}

TEST(WebLimits, WhoComesBeyondTheLimitWaits) {
  HttpLimits limits;
  limits.max_connections = 2;
  EchoHandler handler;
  ServerThread server(handler, limits);
  auto first = std::make_unique<WebClient>(server.port());
  WebClient second(server.port());
  ASSERT_EQ(first->ask("GET", "/")->status, 200);
  ASSERT_EQ(second.ask("GET", "/")->status, 200);
  WebClient third(server.port());
  ASSERT_TRUE(third.send("GET /third HTTP/1.1\r\nHost: localhost\r\n\r\n"));
  const auto rounds = server.rounds();
  EXPECT_FALSE(third.receive(false, milliseconds(300)));
  EXPECT_LT(server.rounds() - rounds, 20U) << "the loop spins while there is no room";
  first.reset();
  EXPECT_EQ(third.receive()->body, "GET /third []");
}

TEST(WebLimits, FiveHundredAtOnceAreServed) {
  EchoHandler handler;
  ServerThread server(handler);
  std::vector<WebClient> clients;
  clients.reserve(500);
  for (int i = 0; i < 500; ++i) {
    clients.emplace_back(server.port());
    ASSERT_TRUE(clients.back().is_connected()) << i;
    ASSERT_TRUE(clients.back().send("GET /" + std::to_string(i) +
                                    " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"));
  }
  for (int i = 0; i < 500; ++i) {
    const auto reply = clients[static_cast<std::size_t>(i)].receive();
    ASSERT_TRUE(reply) << i;
    ASSERT_EQ(reply->body, "GET /" + std::to_string(i) + " []");
  }
  EXPECT_EQ(server.counts().connections, 500U);
}

TEST(WebLimits, MemoryIsFlatOverTenThousandConnections) {
  EchoHandler handler;
  ServerThread server(handler);
  constexpr int kConnections = 10000;
  double after_first_kib = 0;
  for (int i = 0; i < kConnections; ++i) {
    WebClient client(server.port());
    ASSERT_TRUE(client.is_connected()) << i;
    switch (i % 4) {
      case 0:
        ASSERT_EQ(client.ask("POST", "/", {}, "hello").value_or(WebReply()).status, 200) << i;
        break;
      case 1:
        ASSERT_EQ(client.ask("GET", "/..").value_or(WebReply()).status, 400) << i;
        break;
      case 2:
        ASSERT_EQ(client.ask("GET", "/pieces/5").value_or(WebReply()).body.size(), 5000U) << i;
        break;
      default:
        client.send("GET /pieces/500 HTTP/1.1\r\nHost:");
        break;
    }
    if (i == kConnections / 5) after_first_kib = resident_kib();
  }
  ASSERT_EQ(WebClient(server.port()).ask("GET", "/").value_or(WebReply()).status, 200);
  EXPECT_EQ(server.counts().connections, static_cast<std::uint64_t>(kConnections + 1));
  if (!kMemoryIsMeasured) return;
  std::cout << "resident after 2,000 connections " << after_first_kib << " KiB, after 10,000 "
            << resident_kib() << " KiB\n";
  EXPECT_LT(resident_kib() - after_first_kib, 512.0);
}

TEST(WebLimits, TheLoopSleepsWhileNobodyAsks) {
  EchoHandler handler;
  ServerThread server(handler);
  std::this_thread::sleep_for(milliseconds(50));
  const auto alone = server.rounds();
  std::this_thread::sleep_for(milliseconds(500));
  EXPECT_EQ(server.rounds(), alone);
  WebClient idle(server.port());
  ASSERT_EQ(idle.ask("GET", "/")->status, 200);
  std::this_thread::sleep_for(milliseconds(50));
  const auto connected = server.rounds();
  std::this_thread::sleep_for(milliseconds(2100));
  EXPECT_LE(server.rounds() - connected, 5U) << "once a second";
  EXPECT_GE(server.rounds() - connected, 1U);
}

TEST(ConnectionProgressTimes, AreThoseOfItsPhase) {
  HttpLimits limits;
  limits.max_head_time = seconds(1);
  limits.max_body_time = seconds(2);
  limits.max_stall = seconds(3);
  limits.min_bytes_per_s = 100;
  using Phase = ConnectionProgress::Phase;
  const SteadyTime start{};
  EXPECT_FALSE(is_overdue({Phase::head, start}, limits, start + milliseconds(900)));
  EXPECT_TRUE(is_overdue({Phase::head, start}, limits, start + milliseconds(1100)));
  EXPECT_FALSE(is_overdue({Phase::body, start}, limits, start + milliseconds(1900)));
  EXPECT_TRUE(is_overdue({Phase::body, start}, limits, start + milliseconds(2100)));
  // 1000 bytes at 100 a second, and three seconds of grace.
  ConnectionProgress answer{Phase::answer, start, start + seconds(12), 1000};
  EXPECT_FALSE(is_overdue(answer, limits, start + milliseconds(12900)));
  EXPECT_TRUE(is_overdue(answer, limits, start + milliseconds(13100)));
  answer.is_live = true;
  EXPECT_FALSE(is_overdue(answer, limits, start + milliseconds(13100)));
  EXPECT_TRUE(is_overdue(answer, limits, start + milliseconds(15100)));
  answer.is_suspended = true;
  EXPECT_FALSE(is_overdue(answer, limits, start + std::chrono::hours(1)));
}

TEST(PeerCounts, CountIp6ByItsNetwork) {
  PeerCounts counts;
  counts.add(*PeerAddress::parse("2001:db8::1"));
  counts.add(*PeerAddress::parse("2001:db8::ffff:2"));
  EXPECT_EQ(counts.count(*PeerAddress::parse("2001:db8:0:0:7::")), 2U);
  EXPECT_EQ(counts.count(*PeerAddress::parse("2001:db8:0:1::")), 0U);
  counts.add(*PeerAddress::parse("192.0.2.1"));
  EXPECT_EQ(counts.count(*PeerAddress::parse("192.0.2.1")), 1U);
  EXPECT_EQ(counts.count(*PeerAddress::parse("192.0.2.2")), 0U);
  counts.remove(*PeerAddress::parse("2001:db8::1"));
  counts.remove(*PeerAddress::parse("2001:db8::1"));
  EXPECT_EQ(counts.count(*PeerAddress::parse("2001:db8::1")), 0U);
}

}  // namespace
}  // namespace traygauge::test
