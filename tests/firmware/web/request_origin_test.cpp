#include "firmware/web/request_origin.hpp"

#include <gtest/gtest.h>

namespace traygauge::test {
namespace {

class RequestOrigin : public ::testing::Test {
 protected:
  // The status of a refusal, or 200.
  int ask(const char* method, NamedTexts headers) const {
    HttpRequest request;
    request.method = method;
    request.headers = std::move(headers);
    const auto refusal = refuse_foreign(request, hosts_);
    return refusal ? refusal->status : 200;
  }

  OwnHosts hosts_{{"Hub.local", "food.example.org"}};
};

TEST_F(RequestOrigin, HostIsOneOfOurNamesOrAnAddress) {
  for (const char* const host :
       {"localhost", "localhost:8080", "127.0.0.1", "192.0.2.1:80", "[::1]", "[2001:db8::1]:80", "hub.local",
        "HUB.LOCAL:8080", "hub.local.", "food.example.org"}) {
    EXPECT_EQ(ask("GET", {{"host", host}}), 200) << host;
  }
  // A name of an attacker's that points here.
  for (const char* const host :
       {"evil.example", "evil.example:8080", "", "hub.local.evil.example", "127.0.0.1.evil.example",
        "xhub.local", "localhost.evil.example", "[::1", "[evil]", "127.0.0.1@evil.example"}) {
    EXPECT_EQ(ask("GET", {{"host", host}}), 421) << host;
    EXPECT_EQ(ask("POST", {{"host", host}}), 421) << host;
  }
  EXPECT_EQ(ask("GET", {}), 200) << "no browser leaves it out";
}

TEST_F(RequestOrigin, WhatChangesSomethingComesFromOurPage) {
  const NamedText host{"host", "hub.local:8080"};
  EXPECT_EQ(ask("POST", {host}), 200) << "a script";
  EXPECT_EQ(ask("POST", {host, {"origin", "http://hub.local:8080"}}), 200);
  EXPECT_EQ(ask("POST", {host, {"sec-fetch-site", "same-origin"}, {"origin", "http://hub.local:8080"}}), 200);
  for (const char* const method : {"POST", "PUT", "PATCH", "DELETE", "OPTIONS"}) {
    EXPECT_EQ(ask(method, {host, {"origin", "http://evil.example"}}), 403) << method;
    EXPECT_EQ(ask(method, {host, {"origin", "null"}}), 403) << method;
    EXPECT_EQ(ask(method, {host, {"origin", "http://hub.local:9090"}}), 403)
        << method << ": another program there";
    EXPECT_EQ(ask(method, {host, {"origin", "http://192.0.2.66"}}), 403) << method;
    EXPECT_EQ(ask(method, {host, {"sec-fetch-site", "cross-site"}}), 403) << method;
    EXPECT_EQ(ask(method, {host, {"sec-fetch-site", "same-site"}}), 403) << method;
  }
}

TEST_F(RequestOrigin, AProxyMayChangeTheHost) {
  EXPECT_EQ(ask("POST", {{"host", "127.0.0.1:8080"}, {"origin", "https://food.example.org"}}), 200);
  EXPECT_EQ(ask("POST", {{"host", "127.0.0.1:8080"},
                         {"x-forwarded-host", "food.example.org:8443"},
                         {"origin", "https://food.example.org:8443"}}),
            200);
  EXPECT_EQ(ask("POST", {{"host", "127.0.0.1:8080"}, {"origin", "https://evil.example"}}), 403);
}

TEST_F(RequestOrigin, OtherSitesMayLinkHereAndReadNothing) {
  const NamedText host{"host", "localhost"};
  EXPECT_EQ(ask("GET", {host, {"sec-fetch-site", "cross-site"}, {"sec-fetch-mode", "navigate"}}), 200);
  EXPECT_EQ(ask("GET", {host, {"sec-fetch-site", "cross-site"}, {"sec-fetch-mode", "no-cors"}}), 403);
  EXPECT_EQ(ask("GET", {host, {"sec-fetch-site", "cross-site"}}), 403);
  EXPECT_EQ(ask("GET", {host, {"sec-fetch-site", "same-origin"}}), 200);
}

}  // namespace
}  // namespace traygauge::test
