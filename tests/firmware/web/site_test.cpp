// The whole: a site behind a server, asked over sockets.
#include "firmware/web/site.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>
#include <string>
#include <thread>

#include "firmware/web/login.hpp"
#include "tests/firmware/web/known_tokens.hpp"
#include "tests/firmware/web/server_thread.hpp"
#include "tests/firmware/web/web_client.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

HttpLimits quick_limits() {
  HttpLimits limits;
  limits.sweep_interval = milliseconds(20);
  limits.max_stall = milliseconds(500);
  return limits;
}

class WebSite : public ::testing::Test {
 protected:
  WebSite() {
    EXPECT_TRUE(files_.add("index.html", "<p>page</p>").ok());
    router_.add({"GET", "/api/v1/scans/{id}", Role::view, 0, [](const HttpRequest& request) {
                   return json_response("\"" + *request.path_parameter("id") + "\"");
                 }});
    router_.add({"POST", "/api/v1/next-tray", Role::manage, 100,
                 [](const HttpRequest& request) { return json_response(request.body); }});
    router_.add({"GET", "/api/v1/events", Role::view, 0,
                 [this](const HttpRequest& request) { return events_.open(request); }});
    router_.add({"GET", "/health", Role::none, 0, [](const HttpRequest&) { return json_response("{}"); }});
    add_login_routes(router_, access_);
    EXPECT_TRUE(access_.check_listen({}).ok());
  }

  TokenFile write(const char* name, const std::string& text, Role role) const {
    const auto path = folder_.path() / name;
    std::ofstream(path) << text << "\n";
    ::chmod(path.c_str(), 0600);
    return {path, role};
  }
  std::optional<WebReply> ask(std::string_view method, std::string_view target,
                              const std::vector<std::string>& fields = {}, std::string_view body = {}) const {
    return WebClient(server_.port()).ask(method, target, fields, body);
  }
  int status_of(std::string_view method, std::string_view target, const std::vector<std::string>& fields = {},
                std::string_view body = {}) const {
    return ask(method, target, fields, body).value_or(WebReply()).status;
  }
  static std::string bearer(const std::string& token) { return "Authorization: Bearer " + token; }
  WebReply log_in(const std::string& token) const {
    return ask("POST", "/api/v1/login", {"Content-Type: application/json"}, "{\"token\":\"" + token + "\"}")
        .value_or(WebReply());
  }
  std::size_t streams() {
    return server_.between_rounds([this] { return events_.count(); });
  }
  template <class Condition>
  static bool comes_true(Condition condition) {
    for (int i = 0; i < 300; ++i, std::this_thread::sleep_for(milliseconds(10))) {
      if (condition()) return true;
    }
    return false;
  }

  TemporaryFolder folder_;
  Access access_{{{write("view", kViewToken + " hall", Role::view), write("kiosk", kKioskToken, Role::kiosk),
                   write("manage", kManageToken, Role::manage)},
                  LocalRule::open_without_tokens,
                  {},
                  {}}};
  Router router_;
  StaticFiles files_;
  EventStreams events_{{50, 8UL * 1024, milliseconds(100)}, [this](std::string_view last_id) {
                         last_id_ = last_id;
                         return std::vector<WebEvent>{{"scan", "missed", "a-9"}};
                       }};
  std::string last_id_;
  Site site_{{{"hub.local"}, {"kitchen", "scales"}}, access_, router_, files_, events_};
  ServerThread server_{site_, quick_limits()};
};

TEST_F(WebSite, ProtectsEveryAnswer) {
  for (const char* const target : {"/", "/health", "/nothing", "/api/v1/scans/a-1"}) {
    const auto reply = ask("GET", target);
    ASSERT_TRUE(reply) << target;
    EXPECT_NE(reply->header("content-security-policy").find("default-src 'none'"), std::string::npos)
        << target;
    EXPECT_NE(reply->header("content-security-policy").find("frame-ancestors 'none'"), std::string::npos)
        << target;
    EXPECT_EQ(reply->header("content-security-policy").find("unsafe"), std::string::npos) << target;
    EXPECT_EQ(reply->header("x-content-type-options"), "nosniff") << target;
    EXPECT_EQ(reply->header("referrer-policy"), "no-referrer") << target;
    EXPECT_EQ(reply->header("access-control-allow-origin"), "") << target;
  }
}

TEST_F(WebSite, AnswersByPathMethodAndRole) {
  EXPECT_EQ(ask("GET", "/")->body, "<p>page</p>");
  EXPECT_EQ(status_of("GET", "/health"), 200);
  EXPECT_EQ(status_of("GET", "/api/v1/nothing", {bearer(kManageToken)}), 404);
  EXPECT_EQ(ask("GET", "/api/v1/scans/a-1", {bearer(kViewToken)})->body, "\"a-1\"");
  const auto unknown = ask("GET", "/api/v1/scans/a-1");
  EXPECT_EQ(unknown->status, 401);
  EXPECT_EQ(unknown->header("www-authenticate"), "Bearer realm=\"traygauge\"");
  EXPECT_EQ(status_of("POST", "/api/v1/next-tray", {bearer(kViewToken)}, "{}"), 403);
  EXPECT_EQ(status_of("POST", "/api/v1/next-tray", {bearer(kKioskToken)}, "{}"), 403);
  EXPECT_EQ(ask("POST", "/api/v1/next-tray", {bearer(kManageToken)}, "{}")->body, "{}");
  EXPECT_EQ(status_of("POST", "/api/v1/next-tray", {bearer(kManageToken)}, std::string(101, 'x')), 413);
  const auto wrong_method = ask("DELETE", "/api/v1/scans/a-1", {bearer(kManageToken)});
  EXPECT_EQ(wrong_method->status, 405);
  EXPECT_EQ(wrong_method->header("allow"), "GET, HEAD");
  EXPECT_EQ(ask("POST", "/", {}, "x")->header("allow"), "GET, HEAD");
  EXPECT_EQ(status_of("BREW", "/health"), 405);
  const auto page = ask("GET", "/index.html");
  EXPECT_EQ(status_of("GET", "/", {"If-None-Match: " + page->header("etag")}), 304);
}

TEST_F(WebSite, StandsUnderAPathOfAProxy) {
  EXPECT_EQ(ask("GET", "/kitchen/scales/")->body, "<p>page</p>");
  EXPECT_EQ(ask("GET", "/kitchen/scales/api/v1/scans/a-1", {bearer(kViewToken)})->body, "\"a-1\"");
  EXPECT_EQ(status_of("GET", "/kitchen/health"), 404);
}

TEST_F(WebSite, RefusesOtherSites) {
  EXPECT_EQ(status_of("GET", "/", {"Host: evil.example"}), 421);
  EXPECT_EQ(status_of("GET", "/", {"Host: hub.local:8080"}), 200);
  EXPECT_EQ(
      status_of("POST", "/api/v1/next-tray", {bearer(kManageToken), "Origin: http://evil.example"}, "{}"),
      403);
  EXPECT_EQ(status_of("OPTIONS", "/api/v1/next-tray", {"Origin: http://evil.example"}), 403);
}

TEST_F(WebSite, LogsInByACookie) {
  const WebReply kiosk = log_in(kKioskToken);
  ASSERT_EQ(kiosk.status, 200);
  EXPECT_EQ(kiosk.body, R"({"role":"kiosk","name":""})");
  EXPECT_EQ(kiosk.header("set-cookie"),
            "traygauge_token=" + kKioskToken + "; HttpOnly; SameSite=Strict; Max-Age=34560000");
  EXPECT_EQ(log_in(kManageToken).header("set-cookie"),
            "traygauge_token=" + kManageToken + "; HttpOnly; SameSite=Strict");
  const std::string cookie = "Cookie: traygauge_token=" + kKioskToken;
  EXPECT_EQ(status_of("GET", "/api/v1/scans/a-1", {cookie}), 200);
  const auto session = ask("GET", "/api/v1/session", {cookie});
  EXPECT_EQ(session->body, kiosk.body);
  EXPECT_EQ(session->header("set-cookie"), kiosk.header("set-cookie")) << "renewed, so that it does not end";
  EXPECT_EQ(ask("GET", "/api/v1/session", {bearer(kViewToken)})->body, R"({"role":"view","name":"hall"})");
  EXPECT_EQ(ask("GET", "/api/v1/session", {bearer(kKioskToken)})->header("set-cookie"), "");
  EXPECT_EQ(status_of("GET", "/api/v1/session"), 401);
  EXPECT_NE(ask("POST", "/api/v1/logout", {cookie})->header("set-cookie").find("traygauge_token=; "),
            std::string::npos);
  const auto secure =
      ask("POST", "/api/v1/login", {"Content-Type: application/json", "X-Forwarded-Proto: https"},
          "{\"token\":\"" + kViewToken + "\"}");
  EXPECT_TRUE(secure->header("set-cookie").ends_with("; Secure"));
}

TEST_F(WebSite, RefusesWrongLogins) {
  EXPECT_EQ(
      status_of("POST", "/api/v1/login", {"Content-Type: text/plain"}, "{\"token\":\"" + kViewToken + "\"}"),
      415);
  for (const char* const body : {"{", "[]", "{}", "{\"token\":7}", "null", "{\"token\":\"\\ud800\"}"})
    EXPECT_EQ(status_of("POST", "/api/v1/login", {"Content-Type: application/json"}, body), 400) << body;
  EXPECT_EQ(status_of("POST", "/api/v1/login", {"Content-Type: application/json"}, std::string(2000, '[')),
            413);
  for (int i = 0; i < 10; ++i) {
    const WebReply reply = log_in("wrong-token-0123456789\\r\\nX: y");
    ASSERT_EQ(reply.status, 401);
    ASSERT_EQ(reply.header("set-cookie"), "");
  }
  const WebReply limited = log_in(kViewToken);
  EXPECT_EQ(limited.status, 429);
  EXPECT_EQ(limited.header("retry-after"), "10");
  EXPECT_EQ(status_of("GET", "/api/v1/scans/a-1", {bearer(kViewToken), "X-Forwarded-For: 192.0.2.9"}), 429);
}

TEST_F(WebSite, TellsEventsAsTheyHappen) {
  WebClient page(server_.port());
  ASSERT_TRUE(page.send("GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\nLast-Event-ID: a-7\r\n" +
                        bearer(kViewToken) + "\r\n\r\n"));
  const std::string head = page.receive_until("\r\n\r\n");
  EXPECT_NE(head.find("200 OK"), std::string::npos) << head;
  EXPECT_NE(head.find("text/event-stream"), std::string::npos) << head;
  EXPECT_NE(page.receive_until("id: a-9\ndata: missed\n\n"), "");
  EXPECT_EQ(server_.between_rounds([this] { return last_id_; }), "a-7");
  for (int i = 0; i < 100; ++i) {
    server_.between_rounds([this, i] {
      events_.broadcast({"scan", std::to_string(i), "b-" + std::to_string(i)});
    });
    ASSERT_NE(page.receive_until("id: b-" + std::to_string(i) + "\ndata: " + std::to_string(i) + "\n\n"), "")
        << i;
  }
  for (int i = 0; i < 5; ++i) EXPECT_NE(page.receive_until("event: heartbeat\ndata: {}\n\n"), "");
}

TEST_F(WebSite, SleepsWhilePagesListen) {
  std::vector<WebClient> pages;
  for (int i = 0; i < 50; ++i) {
    pages.emplace_back(server_.port());
    ASSERT_TRUE(pages.back().send("GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\n" + bearer(kViewToken) +
                                  "\r\n\r\n"));
  }
  for (WebClient& page : pages) ASSERT_NE(page.receive_until("data: missed\n\n"), "");
  EXPECT_EQ(status_of("GET", "/api/v1/events", {bearer(kViewToken)}), 503);
  EXPECT_EQ(status_of("GET", "/health"), 200);
  const auto rounds = server_.rounds();
  std::this_thread::sleep_for(seconds(1));
  // 50 sweeps of 20 ms, ten heart-beats, and the rounds that send them.
  EXPECT_LT(server_.rounds() - rounds, 150U);
  pages.clear();
  EXPECT_TRUE(comes_true([this] { return streams() == 0; })) << "who left is noticed";
}

TEST_F(WebSite, ClosesPagesThatDoNotRead) {
  WebClient deaf(server_.port());
  ASSERT_TRUE(
      deaf.send("GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\n" + bearer(kViewToken) + "\r\n\r\n"));
  ASSERT_TRUE(comes_true([this] { return streams() == 1; }));
  const bool is_closed = comes_true([this] {
    server_.between_rounds([this] {
      for (int i = 0; i < 7; ++i) events_.broadcast({"scan", std::string(1000, 'x'), ""});
    });
    return streams() == 0;
  });
  EXPECT_TRUE(is_closed);
  EXPECT_TRUE(comes_true([this] { return server_.counts().open == 0; }));
}

TEST_F(WebSite, PagesOfARevokedTokenHaveToComeAgain) {
  WebClient page(server_.port());
  ASSERT_TRUE(
      page.send("GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\n" + bearer(kViewToken) + "\r\n\r\n"));
  ASSERT_NE(page.receive_until("data: missed\n\n"), "");
  write("view", "another-view-token-0123456789", Role::view);
  EXPECT_TRUE(comes_true([this] { return streams() == 0; }));
  EXPECT_EQ(status_of("GET", "/api/v1/events", {bearer(kViewToken)}), 401);
}

TEST_F(WebSite, EndsWhilePagesListen) {
  WebClient page(server_.port());
  ASSERT_TRUE(
      page.send("GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\n" + bearer(kViewToken) + "\r\n\r\n"));
  ASSERT_NE(page.receive_until("data: missed\n\n"), "");
  EXPECT_EQ(status_of("HEAD", "/api/v1/events", {bearer(kViewToken)}), 200);
  EXPECT_EQ(streams(), 1U);
}

}  // namespace
}  // namespace traygauge::test
