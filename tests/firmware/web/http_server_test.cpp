#include "firmware/web/http_server.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "tests/firmware/web/echo_handler.hpp"
#include "tests/firmware/web/server_thread.hpp"
#include "tests/firmware/web/web_client.hpp"
#include "tests/support/random_seed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

class WebServer : public ::testing::Test {
 protected:
  WebClient client() const { return WebClient(server_.port()); }
  std::optional<WebReply> ask(std::string_view method, std::string_view target,
                              const std::vector<std::string>& fields = {}, std::string_view body = {}) const {
    return client().ask(method, target, fields, body);
  }
  int status_of(std::string_view target) const {
    const auto reply = ask("GET", target);
    return reply ? reply->status : 0;
  }

  EchoHandler handler_;
  ServerThread server_{handler_};
};

TEST_F(WebServer, AnswersWithPathAndQueryDecodedOnce) {
  const auto reply = ask("GET", "/api/caf%C3%A9/%2525?name=a+b%26c&empty=&bare");
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->status, 200);
  EXPECT_EQ(reply->body, "GET /api/café/%25 name=a b&c empty= bare= []");
  EXPECT_EQ(reply->header("content-length"), std::to_string(reply->body.size()));
  EXPECT_EQ(reply->header("server"), "traygauge");
}

TEST_F(WebServer, KeepsTheConnection) {
  WebClient one = client();
  for (int i = 0; i < 50; ++i) {
    const std::string target = "/a" + std::to_string(i);
    ASSERT_EQ(one.ask("GET", target)->body, "GET " + target + " []");
  }
  EXPECT_EQ(server_.counts().connections, 1U);
  ASSERT_EQ(one.ask("GET", "/", {"Connection: close"})->status, 200);
  EXPECT_TRUE(one.is_closed_within(std::chrono::seconds(2)));
}

TEST_F(WebServer, AnswersPipelinedRequestsInTheirOrder) {
  WebClient one = client();
  std::string many;
  for (int i = 0; i < 100; ++i)
    many += "POST /" + std::to_string(i) + " HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\n\r\nab";
  ASSERT_TRUE(one.send(many));
  for (int i = 0; i < 100; ++i) {
    const auto reply = one.receive();
    ASSERT_TRUE(reply) << i;
    ASSERT_EQ(reply->body, "POST /" + std::to_string(i) + " [ab]");
  }
}

TEST_F(WebServer, HeadHasTheLengthAndNoBody) {
  WebClient one = client();
  const auto reply = one.ask("HEAD", "/length/5000");
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->status, 200);
  EXPECT_EQ(reply->header("content-length"), "5000");
  // What followed would be taken for a body if one had been sent.
  EXPECT_EQ(one.ask("GET", "/after")->body, "GET /after []");
  EXPECT_EQ(one.ask("HEAD", "/pieces/3")->status, 200);
}

TEST_F(WebServer, TakesBodiesWithLengthAndInChunks) {
  EXPECT_EQ(ask("POST", "/", {}, "hello")->body, "POST / [hello]");
  WebClient one = client();
  ASSERT_TRUE(
      one.send("POST / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n"));
  ASSERT_TRUE(one.send("6\r\n world\r\n0\r\n\r\n"));
  EXPECT_EQ(one.receive()->body, "POST / [hello world]");
  ASSERT_TRUE(
      one.send("POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\nExpect: 100-continue\r\n\r\n"));
  EXPECT_EQ(one.receive()->status, 100);
  ASSERT_TRUE(one.send("ab"));
  EXPECT_EQ(one.receive()->body, "POST / [ab]");
}

TEST_F(WebServer, SendsLongAnswersInPieces) {
  WebClient one = client();
  const auto reply = one.ask("GET", "/pieces/3000");
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->header("transfer-encoding"), "chunked");
  EXPECT_EQ(reply->body, std::string(3000000, 'y'));
  EXPECT_EQ(one.ask("GET", "/length/3000000")->body.size(), 3000000U);
  EXPECT_EQ(one.ask("GET", "/length/0")->body, "");
}

// A reader of the half must not take it for the whole.
TEST_F(WebServer, BreaksOffWhatCannotBeCompleted) {
  WebClient one = client();
  EXPECT_FALSE(one.ask("GET", "/pieces/-1"));
  EXPECT_TRUE(one.is_closed_within(std::chrono::seconds(2)));
  EXPECT_EQ(status_of("/"), 200);
}

TEST_F(WebServer, TellsThatAHandlerFailed) {
  WebClient one = client();
  const auto reply = one.ask("GET", "/throw");
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->status, 500);
  EXPECT_NE(reply->body.find(R"({"error":{"code":"internal_error")"), std::string::npos) << reply->body;
  EXPECT_EQ(reply->body.find("the handler failed"), std::string::npos) << "what() is for the log";
  EXPECT_EQ(one.ask("GET", "/")->status, 200);
}

TEST_F(WebServer, LetsNoHeaderSplitAnAnswer) {
  const auto reply = ask("GET", "/split");
  EXPECT_TRUE(!reply || reply->header("set-cookie").empty());
}

TEST_F(WebServer, RefusesPathsThatLeadElsewhere) {
  for (const char* const target : {"/../etc/passwd",
                                   "/a/../../b",
                                   "/%2e%2e/etc/passwd",
                                   "/%2E%2e%2fetc",
                                   "/a%2fb",
                                   "/a%5cb",
                                   "/a\\b",
                                   "//etc/passwd",
                                   "/a//b",
                                   "/./a",
                                   "/a%00.html",
                                   "/%0d%0aSet-Cookie:x",
                                   "/%c0%ae%c0%ae/",
                                   "/%ff",
                                   "/%",
                                   "/%4",
                                   "/%zz",
                                   "/?a=%00",
                                   "/?a=%zz",
                                   "http://localhost/a",
                                   "a",
                                   "*"}) {
    EXPECT_EQ(status_of(target), 400) << target;
  }
  EXPECT_EQ(ask("GET", "/%252e%252e/a")->body, "GET /%2e%2e/a []") << "decoded once";
  EXPECT_EQ(handler_.answered, 1);
}

TEST_F(WebServer, RefusesRequestsThatProxiesMayReadDifferently) {
  for (const std::string& fields :
       {std::string("Content-Length: 2\r\nContent-Length: 3\r\n"), std::string("Host: other\r\n"),
        std::string("Content-Length: 2\r\nTransfer-Encoding: chunked\r\n"),
        std::string("Transfer-Encoding: gzip, chunked\r\n"), std::string("Content-Length: -2\r\n"),
        std::string("Content-Length: 99999999999999999999999\r\n")}) {
    WebClient one = client();
    ASSERT_TRUE(one.send("POST / HTTP/1.1\r\nHost: localhost\r\n" + fields + "\r\nab"));
    const auto reply = one.receive();
    EXPECT_TRUE(!reply || reply->status >= 400) << fields;
    EXPECT_TRUE(one.is_closed_within(std::chrono::seconds(2)) || reply->status == 400) << fields;
  }
  WebClient without_host = client();
  ASSERT_TRUE(without_host.send("GET / HTTP/1.1\r\n\r\n"));
  EXPECT_EQ(without_host.receive()->status, 400);
  EXPECT_EQ(handler_.answered, 0);
}

TEST_F(WebServer, ReadsARefusedShortBodyAndGoesOn) {
  WebClient one = client();
  EXPECT_EQ(one.ask("POST", "/refused", {}, std::string(500, 'x'))->status, 403);
  EXPECT_EQ(one.ask("POST", "/", {}, std::string(2000, 'x'))->status, 413);
  EXPECT_EQ(one.ask("GET", "/")->status, 200);
  EXPECT_EQ(server_.counts().refused_requests, 2U);
}

TEST_F(WebServer, RefusesLongBodiesUnread) {
  WebClient told = client();
  ASSERT_TRUE(told.send("POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 4000000000\r\n\r\n"));
  EXPECT_EQ(told.receive()->status, 413);
  EXPECT_TRUE(told.is_closed_within(std::chrono::seconds(2)));

  WebClient asks_first = client();
  ASSERT_TRUE(asks_first.send(
      "POST /refused HTTP/1.1\r\nHost: localhost\r\nContent-Length: 9\r\nExpect: 100-continue\r\n\r\n"));
  EXPECT_EQ(asks_first.receive()->status, 403);

  WebClient chunked = client();
  ASSERT_TRUE(chunked.send("POST / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"));
  bool is_taken = true;
  for (int i = 0; i < 1000 && is_taken; ++i)
    is_taken = chunked.send("1000\r\n" + std::string(4096, 'x') + "\r\n");
  EXPECT_TRUE(chunked.is_closed_within(std::chrono::seconds(2)));
  EXPECT_EQ(handler_.answered, 0);
}

TEST_F(WebServer, RefusesHeadsThatAreTooLarge) {
  EXPECT_EQ(ask("GET", "/", {"X-Long: " + std::string(7000, 'x')})->status, 200);
  const auto reply = ask("GET", "/", {"X-Long: " + std::string(9000, 'x')});
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->status, 431);
  for (const std::string& target : {"/" + std::string(9000, 'a'), "/" + std::string(200000, 'a')}) {
    WebClient one = client();
    one.send("GET " + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
    const auto answer = one.receive();
    EXPECT_TRUE(!answer || answer->status == 431 || answer->status == 414) << answer->status;
  }
  WebClient endless = client();
  bool is_taken = endless.send("GET / HTTP/1.1\r\nHost: localhost\r\n");
  for (int i = 0; i < 10000 && is_taken; ++i) is_taken = endless.send("X-" + std::to_string(i) + ": y\r\n");
  EXPECT_TRUE(endless.is_closed_within(std::chrono::seconds(2)));
}

// Whatever comes: an answer or the end, and the next client is served.
TEST_F(WebServer, SurvivesBytesThatAreNoRequest) {
  std::mt19937 random(random_seed());
  const std::string request =
      "POST /a/b?c=d HTTP/1.1\r\nHost: localhost\r\nCookie: a=b; c=d\r\nContent-Length: 3\r\n\r\nxyz";
  for (int run = 0; run < 1500; ++run) {
    std::string bytes = request;
    for (std::size_t changes = 1 + random() % 8; changes > 0; --changes) {
      const std::size_t at = random() % bytes.size();
      switch (random() % 4) {
        case 0:
          bytes[at] = static_cast<char>(random() & 0xFFU);
          break;
        case 1:
          bytes.erase(at, 1 + random() % 9);
          break;
        case 2:
          bytes.insert(at, 1 + random() % 9, static_cast<char>(random() & 0xFFU));
          break;
        default:
          bytes.insert(at, bytes.substr(random() % bytes.size(), 20));
          break;
      }
      if (bytes.empty()) bytes.push_back('\n');
    }
    WebClient one = client();
    one.send(bytes.substr(0, bytes.size() / 2));
    one.send(bytes.substr(bytes.size() / 2));
  }
  std::string garbage(100000, '\0');
  for (char& c : garbage) c = static_cast<char>(random() & 0xFFU);
  WebClient noisy = client();
  noisy.send(garbage);
  EXPECT_EQ(status_of("/"), 200);
}

TEST(WebServerSockets, ListensOnIp6AndUnixSockets) {
  EchoHandler handler;
  {
    ServerThread server(handler, {}, "[::1]:0");
    WebClient client(server.port(), "::1");
    ASSERT_TRUE(client.is_connected());
    EXPECT_EQ(client.ask("GET", "/six")->body, "GET /six []");
  }
  {
    ServerThread server(handler, {}, "*:0");
    EXPECT_EQ(WebClient(server.port(), "::1").ask("GET", "/")->status, 200);
    EXPECT_EQ(WebClient(server.port()).ask("GET", "/")->status, 200);
  }
  const TemporaryFolder folder;
  const auto path = folder.path() / "web";
  {
    ServerThread server(handler, {}, path.string());
    EXPECT_EQ(WebClient(path).ask("GET", "/local")->body, "GET /local []");
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace traygauge::test
