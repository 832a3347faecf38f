#include "firmware/support/secret_filter.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace traygauge {
namespace {

std::string cleaned(const std::string& text) {
  SecretFilter filter;
  filter.add_file_content("# keys of the door\nabcdefgh ann\nefghijkl\tChristine\r\n\nxy bob\n");
  return filter.clean(text);
}

TEST(SecretFilterTest, RemovesWordsOfSecretFiles) {
  EXPECT_EQ(cleaned("abcdefgh."), "(removed).");
  EXPECT_EQ(cleaned("by Christine, ann and bob, in May"), "by (removed), ann and bob, in May");
  EXPECT_EQ(cleaned("xy, abcdefg"), "xy, abcdefg");
}

TEST(SecretFilterTest, LeavesNoRestOfSecretsThatOverlap) {
  EXPECT_EQ(cleaned("<abcdefghijkl>"), "<(removed)>");
  EXPECT_EQ(cleaned("<abcdefghabcdefgh>"), "<(removed)(removed)>");
}

TEST(SecretFilterTest, KnowsWhatOthersMakeOfASecret) {
  SecretFilter filter;
  filter.add("a\"b/c d");
  for (const char* const form : {"a\"b/c d", R"(a\"b/c d)", "a%22b%2Fc%20d", "a%22b%2fc%20d", "a%22b/c%20d"})
    EXPECT_EQ(filter.clean(std::string("<").append(form).append(">")), "<(removed)>");
}

TEST(SecretFilterTest, KeepsSchemeHostAndPortOfAddresses) {
  for (const auto& [text, wanted] : {std::pair{"http://u:p@host:81/path?x=1", "http://host:81/(removed)"},
                                     {"(https://host)", "(https://host)"},
                                     {"\"mqtts://u:p@host\", next", "\"mqtts://host\", next"},
                                     {"http://u:p/w@host/path", "http://(removed)"},
                                     {"http://host/a@b", "http://(removed)"},
                                     {"http://", "http://"}}) {
    EXPECT_EQ(SecretFilter().clean(text), wanted);
  }
}

TEST(SecretFilterTest, RemovesWhatIsAnnouncedAsASecret) {
  for (const auto& [text, wanted] : {std::pair{"BEARER abc def", "BEARER (removed) def"},
                                     {"token=abc&x=1", "token=(removed)&x=1"},
                                     {"\"Password\" : \"abc\", 7", "\"Password\" : \"(removed)\", 7"},
                                     {"?token%3Dabc", "?token%3D(removed)"},
                                     {"Cookie: a=b; c=d\nnext", "Cookie: (removed)\nnext"},
                                     {"webhook_secret = \"secret.file\"", "webhook_secret = \"secret.file\""},
                                     {"a token of mine, tokens: 3", "a token of mine, tokens: 3"},
                                     {"token=", "token="}}) {
    EXPECT_EQ(SecretFilter().clean(text), wanted);
  }
}

// Whatever stands around it.
TEST(SecretFilterTest, FindsASecretInAnyText) {
  const std::string secret = "k7-Secret/Word+of=Mine";
  SecretFilter filter;
  filter.add(secret);
  filter.add("Secret/");
  std::mt19937 random(20'261'127);
  const std::string letters = "k7-Sec:/@?=& \n\"%Bearertoken";
  for (int run = 0; run < 2000; ++run) {
    std::string text;
    for (int i = 0; i < 60; ++i) text += letters[random() % letters.size()];
    text.insert(random() % text.size(), secret);
    EXPECT_EQ(filter.clean(text).find("Word+of"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace traygauge
