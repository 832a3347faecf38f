#include "firmware/web/peer_address.hpp"

#include <gtest/gtest.h>

#include "firmware/web/listener.hpp"

namespace traygauge::test {
namespace {

TEST(PeerAddresses, AreReadAndWritten) {
  for (const char* const text : {"192.0.2.1", "::1", "2001:db8::7", "127.3.2.1"})
    EXPECT_EQ(PeerAddress::parse(text)->text(), text);
  EXPECT_EQ(PeerAddress::parse("::ffff:192.0.2.1"), PeerAddress::parse("192.0.2.1")) << "one machine";
  for (const char* const text : {"", "1.2.3", "hub.local", "1.2.3.4 ", "::1%lo", "1.2.3.256", "01.2.3.4"})
    EXPECT_FALSE(PeerAddress::parse(text)) << text;
  EXPECT_EQ(PeerAddress().text(), "unix");
}

TEST(PeerAddresses, AreOnThisMachineOrNot) {
  for (const char* const text : {"127.0.0.1", "127.200.0.1", "::1", "::ffff:127.0.0.1"})
    EXPECT_TRUE(PeerAddress::parse(text)->is_local()) << text;
  for (const char* const text : {"128.0.0.1", "::2", "::", "0.0.0.0", "10.0.0.1"})
    EXPECT_FALSE(PeerAddress::parse(text)->is_local()) << text;
  EXPECT_TRUE(PeerAddress().is_local());
}

TEST(AddressRanges, HoldWhatTheirFirstBitsSay) {
  struct Case {
    const char* range;
    const char* inside;
    const char* outside;
  };
  for (const Case& c :
       {Case{"10.0.0.0/8", "10.255.1.2", "11.0.0.0"}, Case{"192.0.2.128/25", "192.0.2.200", "192.0.2.127"},
        Case{"192.0.2.1", "192.0.2.1", "192.0.2.0"}, Case{"fd00::/8", "fdff::1", "fe00::1"},
        Case{"2001:db8::/33", "2001:db8:7fff::", "2001:db8:8000::"}, Case{"0.0.0.0/0", "8.8.8.8", "::1"}}) {
    const auto range = AddressRange::parse(c.range);
    ASSERT_TRUE(range) << c.range;
    EXPECT_TRUE(range->holds(*PeerAddress::parse(c.inside))) << c.range;
    EXPECT_FALSE(range->holds(*PeerAddress::parse(c.outside))) << c.range;
    EXPECT_FALSE(range->holds(PeerAddress())) << c.range;
  }
  EXPECT_TRUE(AddressRange::parse("unix")->holds(PeerAddress()));
  EXPECT_FALSE(AddressRange::parse("unix")->holds(*PeerAddress::parse("::1")));
  for (const char* const text :
       {"", "10.0.0.0/33", "10.0.0.0/", "10.0.0.0/x", "::/129", "10.0.0.0/-1", "all"})
    EXPECT_FALSE(AddressRange::parse(text)) << text;
}

TEST(ListenAddresses, AreReadAndWritten) {
  for (const char* const text : {"127.0.0.1:8080", "[::1]:8080", "0.0.0.0:1", "/run/traygauge/web"})
    EXPECT_EQ(parse_listen_address(text)->text(), text);
  EXPECT_EQ(parse_listen_address("localhost:80")->text(), "127.0.0.1:80");
  EXPECT_EQ(parse_listen_address("*:80")->text(), "[::]:80");
  EXPECT_TRUE(parse_listen_address("/run/web")->is_local());
  EXPECT_FALSE(parse_listen_address("*:80")->is_local());
  EXPECT_FALSE(parse_listen_address("192.0.2.1:80")->is_local());
  for (const std::string& text :
       {std::string(""), std::string("8080"), std::string("127.0.0.1"), std::string("::1:8080"),
        std::string("127.0.0.1:65536"), std::string("hub.local:80"), std::string("127.0.0.1:80x"),
        "/" + std::string(200, 'x')}) {
    const auto address = parse_listen_address(text);
    ASSERT_FALSE(address.ok()) << text;
    EXPECT_NE(address.failure().find("expected"), std::string::npos);
  }
}

TEST(Listeners, SayWhyTheyCannotListen) {
  auto first = Listener::open(*parse_listen_address("127.0.0.1:0"));
  ASSERT_TRUE(first.ok()) << first.failure();
  const auto second = Listener::open(first->address());
  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.failure().find("another program listens there"), std::string::npos) << second.failure();
  const auto foreign = Listener::open(*parse_listen_address("192.0.2.1:8080"));
  ASSERT_FALSE(foreign.ok());
  EXPECT_NE(foreign.failure().find("does not have that address"), std::string::npos) << foreign.failure();
}

}  // namespace
}  // namespace traygauge::test
