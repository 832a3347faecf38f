#include "firmware/webhook/http_sender.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <netdb.h>

#include <algorithm>
#include <cstring>
#include <thread>

#include "tests/firmware/store/memory_folder.hpp"
#include "tests/firmware/webhook/call_time.hpp"
#include "tests/firmware/webhook/receiver.hpp"
#include "tests/firmware/webhook/tls_receiver.hpp"

namespace traygauge::test {
namespace {

using std::chrono::milliseconds;

struct Sent {
  SendOutcome outcome;
  std::chrono::microseconds longest_call{0};
  milliseconds took{0};
};

HttpSenderParams params_for(const std::string& url) {
  HttpSenderParams params;
  params.url = url;
  params.shown = "the till";
  params.connect_within = milliseconds(200);
  params.answer_within = milliseconds(300);
  return params;
}

Sent send(HttpSenderParams params) {
  using SteadyClock = std::chrono::steady_clock;
  Sent sent;
  const auto begin = SteadyClock::now();
  {
    Expected<HttpSender> sender = HttpSender::create(std::move(params));
    if (!sender.ok()) throw std::runtime_error(sender.failure());
    const auto timed = [&](const auto& call) {
      sent.longest_call = std::max(sent.longest_call, call_time(call));
    };
    timed([&] { sender->start("{}", {"Content-Type: application/json"}); });
    while (sender->is_busy()) {
      std::vector<pollfd> descriptors;
      sender->add_descriptors(descriptors);
      const auto wait = std::min(milliseconds(100), sender->timeout().value_or(milliseconds(100)));
      ::poll(descriptors.data(), descriptors.size(), static_cast<int>(wait.count()));
      timed([&] {
        if (const auto outcome = sender->attend()) sent.outcome = *outcome;
      });
    }
    // What it leaves behind must not hold the loop either.
    timed([&] { *sender = std::move(*HttpSender::create(params_for("http://127.0.0.1"))); });
  }
  sent.took = std::chrono::duration_cast<milliseconds>(SteadyClock::now() - begin);
  return sent;
}

Sent send_to(const Reply& reply) {
  const Receiver receiver([&](const ReceivedMessage&) { return reply; });
  return send(params_for(receiver.url()));
}

TEST(HttpSender, AnyAnswerWithAWholeHeadCounts) {
  EXPECT_EQ(send_to(Reply::status(200)).outcome.status, 200);
  EXPECT_EQ(send_to(Reply::status(503)).outcome.status, 503);
  EXPECT_EQ(send_to({"HTTP/1.1 204 None\r\n\r\n"}).outcome.status, 204);
  EXPECT_EQ(
      send_to({"HTTP/1.1 100 Continue\r\n\r\nHTTP/1.1 201 Made\r\nContent-Length: 0\r\n\r\n"}).outcome.status,
      201);
  // However its body goes on.
  EXPECT_EQ(send_to({"HTTP/1.1 200 OK\r\nContent-Length: 99\r\n\r\nnever all"}).outcome.status, 200);
  EXPECT_EQ(send_to({"HTTP/1.1 200 OK\r\nContent-Length: 99\r\n\r\nnever all", true}).outcome.status, 200);
  EXPECT_EQ(send_to({"HTTP/1.1 200 OK\r\n\r\n" + std::string(200'000, 'x'), true}).outcome.status, 200);
}

TEST(HttpSender, ARedirectIsNotFollowed) {
  const Receiver elsewhere([](const ReceivedMessage&) { return Reply::status(200); });
  for (const int status : {301, 302, 307, 308})
    EXPECT_EQ(send_to(Reply::status(status, "Location: " + elsewhere.url() + "\r\n")).outcome.status, status);
  EXPECT_TRUE(elsewhere.received().empty());
}

TEST(HttpSender, SaysWhatABadReceiverDid) {
  const auto problem = [](const Reply& reply) {
    const Sent sent = send_to(reply);
    EXPECT_EQ(sent.outcome.status, 0);
    EXPECT_LT(sent.longest_call, milliseconds(50));
    EXPECT_LT(sent.took, milliseconds(1000));
    return sent.outcome.problem;
  };
  EXPECT_EQ(problem({}), "the till took the message and did not answer in time.");
  EXPECT_EQ(problem({"HTTP/1.1 200 OK\r\nSlow: "}), "the till took the message and did not answer in time.");
  EXPECT_EQ(problem({"", true}), "the till closed the connection without a whole answer.");
  EXPECT_EQ(problem({"HTTP/1.1 200 OK\r\nContent-Le", true}),
            "the till closed the connection without a whole answer.");
  EXPECT_EQ(problem({"\x16\x03rubbish\r\n\r\n", true}), "the till answered something that is not HTTP.");
  EXPECT_EQ(problem({"HTTP/1.1 200 OK\r\n", false, "A: " + std::string(1000, 'x') + "\r\n"}),
            "the till answered with a head longer than 64 kB.");
  EXPECT_EQ(problem({{}, false, std::string(4000, 'x')}), "the till answered something that is not HTTP.");
}

TEST(HttpSender, ReadsNoMoreOfALongAnswerThanItHasTo) {
  const Receiver receiver([](const ReceivedMessage&) {
    return Reply{"HTTP/1.1 200 OK\r\n\r\n", false, std::string(50'000, 'x')};
  });
  HttpSenderParams params = params_for(receiver.url());
  params.answer_within = milliseconds(5000);
  const Sent sent = send(std::move(params));
  EXPECT_EQ(sent.outcome.status, 200);
  EXPECT_LT(sent.took, milliseconds(2500)) << "it ended before the time was over";
}

TEST(HttpSender, NobodyListens) {
  std::uint16_t port = 0;
  listen_anywhere(port).close();
  const Sent sent = send(params_for("http://127.0.0.1:" + std::to_string(port) + "/secret?key=1"));
  EXPECT_EQ(sent.outcome.problem, "the till takes no connection (Connection refused).");
}

TEST(HttpSender, ANameServerThatHangsHoldsNothing) {
  const Sent sent = send(params_for("http://hangs.example/"));
  EXPECT_EQ(sent.outcome.problem, "the till could not be reached in time.");
  EXPECT_LT(sent.longest_call, milliseconds(50));
  EXPECT_LT(sent.took, milliseconds(1000)) << "the look-up takes 1.5 s";
  EXPECT_NE(send(params_for("http://unknown.example/")).outcome.problem.find("cannot be looked up"),
            std::string::npos);
  // The thread that was left behind has to end before the program does.
  std::this_thread::sleep_for(milliseconds(1500));
}

TEST(HttpSender, TrustsTheRightCertificateAlone) {
  const MemoryFolder folder;
  const Certificate own("localhost");
  const Certificate other("localhost");
  const Certificate elsewhere("elsewhere.example");
  own.write(folder.path() / "own.pem");
  other.write(folder.path() / "other.pem");
  elsewhere.write(folder.path() / "elsewhere.pem");
  const TlsReceiver receiver(own);
  const TlsReceiver misnamed(elsewhere);
  const auto sent = [&](const TlsReceiver& to, const std::string& trusted) {
    HttpSenderParams params = params_for("https://localhost:" + std::to_string(to.port()) + "/");
    if (!trusted.empty()) params.trusted_file = folder.path() / trusted;
    return send(std::move(params)).outcome;
  };
  EXPECT_EQ(sent(receiver, "own.pem").status, 200) << sent(receiver, "own.pem").problem;
  for (const SendOutcome& refused :
       {sent(receiver, "other.pem"), sent(receiver, ""), sent(misnamed, "elsewhere.pem")}) {
    EXPECT_EQ(refused.status, 0);
    EXPECT_NE(refused.problem.find("The certificate of the till is not trusted"), std::string::npos)
        << refused.problem;
  }
  // As Debian keeps those of the system.
  HttpSenderParams params = params_for("https://localhost:" + std::to_string(receiver.port()) + "/");
  params.trusted_folder = folder.path() / "trusted";
  own.link_into(params.trusted_folder);
  EXPECT_EQ(send(std::move(params)).outcome.status, 200);
}

}  // namespace
}  // namespace traygauge::test

// The whole program looks names up here, libcurl as well: two names behave badly, the others are this
// machine's.
extern "C" int getaddrinfo(const char* node, const char* service, const addrinfo* hints, addrinfo** result) {
  using Function = int (*)(const char*, const char*, const addrinfo*, addrinfo**);
  static const auto kReal = reinterpret_cast<Function>(::dlsym(RTLD_NEXT, "getaddrinfo"));
  if (node != nullptr && std::strcmp(node, "hangs.example") == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    return EAI_AGAIN;
  }
  if (node != nullptr && std::strcmp(node, "unknown.example") == 0) return EAI_NONAME;
  return kReal(node, service, hints, result);
}
