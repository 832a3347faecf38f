#include "firmware/web/access.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <string>

#include "tests/firmware/web/known_tokens.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

using std::chrono::seconds;

class WebAccess : public ::testing::Test {
 protected:
  WebAccess() {
    with_tokens_.token_files = {write("view", kViewToken, Role::view),
                                write("manage", kManageToken, Role::manage)};
  }
  TokenFile write(const char* name, const std::string& text, Role role) const {
    const auto path = folder_.path() / name;
    std::ofstream(path) << text << " " << name << "\n";
    ::chmod(path.c_str(), 0600);
    return {path, role};
  }
  static HttpRequest request_from(const char* peer, NamedTexts headers = {}) {
    HttpRequest request;
    request.method = "GET";
    if (std::string(peer) != "unix") request.peer = *PeerAddress::parse(peer);
    request.headers = std::move(headers);
    return request;
  }
  // The status of a refusal, or 200.
  static int ask(Access& access, HttpRequest request, Role minimum = Role::view,
                 SteadyTime now = SteadyTime(seconds(10))) {
    const auto refusal = access.admit(request, minimum, now);
    return refusal ? refusal->status : 200;
  }
  static NamedTexts bearer(const std::string& token) { return {{"authorization", "Bearer " + token}}; }
  static std::string listen_failure(const AccessParams& params, const char* address) {
    const auto checked = Access(params).check_listen({*parse_listen_address(address)});
    return checked.ok() ? "" : checked.failure();
  }

  TemporaryFolder folder_;
  AccessParams with_tokens_;
};

TEST_F(WebAccess, ListensElsewhereWithTokensAlone) {
  const AccessParams none;
  EXPECT_EQ(listen_failure(none, "127.0.0.1:80"), "");
  EXPECT_EQ(listen_failure(none, "[::1]:80"), "");
  EXPECT_EQ(listen_failure(none, "/run/web"), "");
  for (const char* const address : {"0.0.0.0:80", "192.0.2.1:80", "*:80", "[2001:db8::1]:80"}) {
    EXPECT_NE(listen_failure(none, address).find("name one, or listen on 127.0.0.1"), std::string::npos)
        << address;
    EXPECT_EQ(listen_failure(with_tokens_, address), "") << address;
  }
  AccessParams behind_proxy;
  behind_proxy.local = LocalRule::tokens;
  EXPECT_NE(listen_failure(behind_proxy, "127.0.0.1:80").find("name one"), std::string::npos);
  AccessParams broken = with_tokens_;
  ::chmod(broken.token_files[0].path.c_str(), 0644);
  EXPECT_NE(listen_failure(broken, "127.0.0.1:80").find("chmod 600"), std::string::npos);
}

TEST_F(WebAccess, IsOpenOnThisMachineWithoutTokens) {
  Access access{AccessParams{}};
  HttpRequest request = request_from("127.0.0.1");
  EXPECT_FALSE(access.admit(request, Role::manage, SteadyTime()));
  EXPECT_EQ(request.role, Role::manage);
  EXPECT_EQ(ask(access, request_from("unix"), Role::manage), 200);
  EXPECT_EQ(ask(access, request_from("::1"), Role::manage), 200);
  EXPECT_EQ(ask(access, request_from("192.0.2.1")), 401);
  // A proxy on this machine brings others.
  for (const char* const name :
       {"x-forwarded-for", "forwarded", "via", "x-real-ip", "x-forwarded-host", "x-forwarded-proto"})
    EXPECT_EQ(ask(access, request_from("127.0.0.1", {{name, "127.0.0.1"}})), 401) << name;
}

TEST_F(WebAccess, DemandsTokensEverywhereOnceTheyAreNamed) {
  Access access(with_tokens_);
  for (const char* const peer : {"127.0.0.1", "unix", "192.0.2.1"}) {
    EXPECT_EQ(ask(access, request_from(peer)), 401) << peer;
    EXPECT_EQ(ask(access, request_from(peer), Role::none), 200) << peer;
    EXPECT_EQ(ask(access, request_from(peer, bearer(kViewToken))), 200) << peer;
    EXPECT_EQ(ask(access, request_from(peer, bearer(kViewToken)), Role::manage), 403) << peer;
    EXPECT_EQ(ask(access, request_from(peer, bearer(kManageToken)), Role::manage), 200) << peer;
    EXPECT_EQ(ask(access, request_from(peer, bearer("wrong"))), 401) << peer;
  }
  with_tokens_.local = LocalRule::open;
  Access open(with_tokens_);
  EXPECT_EQ(ask(open, request_from("127.0.0.1"), Role::manage), 200);
  EXPECT_EQ(ask(open, request_from("127.0.0.1", {{"x-forwarded-for", "127.0.0.1"}})), 401);
  EXPECT_EQ(ask(open, request_from("192.0.2.1")), 401);
}

TEST_F(WebAccess, TakesTheTokenFromHeaderOrCookieAndNowhereElse) {
  Access access(with_tokens_);
  HttpRequest request =
      request_from("192.0.2.1", {{"cookie", "a=b; traygauge_token=" + kViewToken + "; c=d"}});
  EXPECT_FALSE(access.admit(request, Role::view, SteadyTime(seconds(10))));
  EXPECT_EQ(request.role, Role::view);
  EXPECT_EQ(request.token_name, "view");
  EXPECT_EQ(ask(access, request_from("192.0.2.1", {{"authorization", "bearer  " + kViewToken}})), 200);
  EXPECT_EQ(ask(access, request_from("192.0.2.1", {{"authorization", "Basic " + kViewToken}})), 401);
  EXPECT_EQ(ask(access, request_from("192.0.2.1", {{"cookie", "traygauge_token_2=" + kViewToken + ";x"}})),
            401);
  EXPECT_EQ(ask(access, request_from("192.0.2.1", {{"cookie", "=;;traygauge_token"}})), 401);
  HttpRequest in_address = request_from("192.0.2.1");
  in_address.query = {{"token", kViewToken}, {"access_token", kViewToken}, {"traygauge_token", kViewToken}};
  EXPECT_EQ(ask(access, in_address), 401);
}

TEST_F(WebAccess, LimitsAttemptsWhateverHeadersSay) {
  Access access(with_tokens_);
  SteadyTime now(seconds(100));
  for (int i = 0; i < 10; ++i) {
    NamedTexts forged = bearer("wrong-token-0123456789");
    forged.emplace_back("x-forwarded-for", "198.51.100." + std::to_string(i));
    ASSERT_EQ(ask(access, request_from("192.0.2.1", forged), Role::view, now), 401) << i;
  }
  NamedTexts right = bearer(kViewToken);
  EXPECT_EQ(ask(access, request_from("192.0.2.1", right), Role::view, now), 429) << "not even looked at";
  right.emplace_back("x-forwarded-for", "203.0.113.7");
  EXPECT_EQ(ask(access, request_from("192.0.2.1", right), Role::view, now), 429);
  EXPECT_EQ(ask(access, request_from("192.0.2.2", right), Role::view, now), 200) << "others are not meant";
  EXPECT_EQ(ask(access, request_from("192.0.2.1"), Role::none, now), 200);
  now += seconds(10);
  EXPECT_EQ(ask(access, request_from("192.0.2.1", right), Role::view, now), 200);
}

TEST_F(WebAccess, BelievesTrustedProxiesAlone) {
  with_tokens_.trusted_proxies = {*AddressRange::parse("127.0.0.1"), *AddressRange::parse("10.0.0.0/8"),
                                  *AddressRange::parse("unix")};
  Access access(with_tokens_);
  const auto client = [&access](const char* peer, NamedTexts headers) {
    return access.client_of(request_from(peer, std::move(headers))).address.text();
  };
  EXPECT_EQ(client("127.0.0.1", {{"x-forwarded-for", "192.0.2.7"}}), "192.0.2.7");
  EXPECT_EQ(client("unix", {{"x-forwarded-for", "192.0.2.7:4711"}}), "192.0.2.7");
  EXPECT_EQ(client("127.0.0.1", {{"x-forwarded-for", "[2001:db8::1]:80"}}), "2001:db8::1");
  // The client wrote what is further left.
  EXPECT_EQ(client("127.0.0.1", {{"x-forwarded-for", "8.8.8.8, 192.0.2.7 , 10.1.1.1"}}), "192.0.2.7");
  EXPECT_EQ(client("127.0.0.1", {{"x-forwarded-for", "8.8.8.8"}, {"x-forwarded-for", "192.0.2.7"}}),
            "192.0.2.7");
  EXPECT_EQ(client("127.0.0.1", {{"x-forwarded-for", "10.2.2.2, 10.1.1.1"}}), "10.2.2.2");
  EXPECT_EQ(client("127.0.0.1", {{"x-forwarded-for", "8.8.8.8, nonsense"}}), "127.0.0.1");
  EXPECT_EQ(client("127.0.0.1", {{"x-forwarded-for", ""}}), "127.0.0.1");
  EXPECT_EQ(client("127.0.0.1", {{"x-real-ip", "8.8.8.8"}}), "127.0.0.1");
  EXPECT_EQ(client("192.0.2.1", {{"x-forwarded-for", "8.8.8.8"}}), "192.0.2.1");

  SteadyTime now(seconds(100));
  for (int i = 0; i < 10; ++i) {
    NamedTexts forged = bearer("wrong-token-0123456789");
    forged.emplace_back("x-forwarded-for", "198.51.100." + std::to_string(i) + ", 192.0.2.7");
    ASSERT_EQ(ask(access, request_from("127.0.0.1", forged), Role::view, now), 401);
  }
  NamedTexts right = bearer(kViewToken);
  right.emplace_back("x-forwarded-for", "192.0.2.7");
  EXPECT_EQ(ask(access, request_from("127.0.0.1", right), Role::view, now), 429);
  right.back().second = "192.0.2.8";
  EXPECT_EQ(ask(access, request_from("127.0.0.1", right), Role::view, now), 200);
}

TEST(AttemptLimits, ForgiveOneFailureAnInterval) {
  AttemptLimiter limiter({3, seconds(10), 4});
  const PeerAddress peer = *PeerAddress::parse("2001:db8::1");
  const PeerAddress neighbour = *PeerAddress::parse("2001:db8::ffff");
  SteadyTime now(seconds(1));
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(limiter.may_try(peer, now));
    limiter.note_failure(i == 1 ? neighbour : peer, now);
  }
  EXPECT_FALSE(limiter.may_try(neighbour, now)) << "a /64 is one peer";
  EXPECT_TRUE(limiter.may_try(*PeerAddress::parse("2001:db8:0:1::1"), now));
  EXPECT_FALSE(limiter.may_try(peer, now + seconds(9)));
  EXPECT_TRUE(limiter.may_try(peer, now + seconds(10)));
  limiter.note_failure(peer, now + seconds(10));
  EXPECT_FALSE(limiter.may_try(peer, now + seconds(19)));
  EXPECT_TRUE(limiter.may_try(peer, now + seconds(1000)));
}

TEST(AttemptLimits, RememberSoManyPeers) {
  AttemptLimiter limiter({1, seconds(10), 4});
  SteadyTime now(seconds(1));
  for (int i = 0; i < 100; ++i) {
    now += std::chrono::milliseconds(1);
    limiter.note_failure(*PeerAddress::parse("192.0.2." + std::to_string(i)), now);
  }
  EXPECT_EQ(limiter.size(), 4U);
  EXPECT_TRUE(limiter.may_try(*PeerAddress::parse("192.0.2.1"), now)) << "the oldest is forgotten";
  EXPECT_FALSE(limiter.may_try(*PeerAddress::parse("192.0.2.99"), now));
}

}  // namespace
}  // namespace traygauge::test
