#include "firmware/web/request_target.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    result += '%';
    result += "0123456789ABCDEF"[code / 16];
    result += "0123456789abcdef"[code % 16];
  }
  return result;
}

TEST(RequestTargetText, IsTakenApart) {
  const auto target = parse_target("/api/v1/?from=2026&from=2027&x");
  ASSERT_TRUE(target.ok());
  EXPECT_EQ(target->segments, (std::vector<std::string>{"api", "v1"}));
  EXPECT_TRUE(target->is_folder);
  EXPECT_EQ(target->query, (NamedTexts{{"from", "2026"}, {"from", "2027"}, {"x", ""}}));
  EXPECT_EQ(*find_text(target->query, "from"), "2026");
  EXPECT_EQ(find_text(target->query, "to"), nullptr);
  EXPECT_TRUE(parse_target("/")->segments.empty());
  EXPECT_EQ(path_text({}), "/");
  EXPECT_EQ(path_text({"a", "b"}), "/a/b");
}

TEST(RequestTargetText, HasSoManyPartsAtMost) {
  std::string path, query = "/?";
  for (int i = 0; i < 64; ++i) path += "/a", query += "a&";
  EXPECT_TRUE(parse_target(path).ok());
  EXPECT_FALSE(parse_target(path + "/a").ok());
  EXPECT_TRUE(parse_target(query).ok());
  EXPECT_FALSE(parse_target(query + "a").ok());
}

// What was escaped comes back, whatever it is, unless it could lead elsewhere.
TEST(RequestTargetText, ComesBackAsItWasEscaped) {
  std::mt19937 random(random_seed());
  int taken = 0;
  for (int run = 0; run < 20000; ++run) {
    std::string text(1 + random() % 4, '\0');
    for (char& c : text)
      c = static_cast<char>(random() % 3 == 0 ? random() & 0xFFU : 0x20 + random() % 0x5FU);
    const auto path = parse_target("/" + escaped(text));
    const auto query = parse_target("/?" + escaped(text) + "=" + escaped(text));
    if (query.ok()) {
      ++taken;
      ASSERT_EQ(query->query, (NamedTexts{{text, text}}));
      ASSERT_TRUE(is_utf8(text));
      for (const char c : text) ASSERT_GE(static_cast<unsigned char>(c), 0x20);
    }
    if (path.ok()) {
      ASSERT_EQ(path->segments, std::vector<std::string>{text});
    }
    const bool leads_elsewhere =
        text == "." || text == ".." || text.find_first_of("/\\") != std::string::npos;
    ASSERT_EQ(path.ok(), query.ok() && !leads_elsewhere) << testing::PrintToString(text);
  }
  EXPECT_GT(taken, 1000);
}

TEST(RequestTargetText, IsUtf8) {
  for (const char* const text : {"", "a", "é", "€", "😀", "\xED\x9F\xBF", "\xF4\x8F\xBF\xBF"})
    EXPECT_TRUE(is_utf8(text)) << text;
  for (const char* const text : {"\x80", "\xC3", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80",
                                 "\xF4\x90\x80\x80", "\xF8\x88\x80\x80\x80", "\xC3(", "\xFF"})
    EXPECT_FALSE(is_utf8(text)) << text;
}

TEST(BasePath, IsAPathOrNothing) {
  EXPECT_TRUE(parse_base_path("")->empty());
  EXPECT_TRUE(parse_base_path("/")->empty());
  EXPECT_EQ(parse_base_path("/kitchen/scales/").value(), (std::vector<std::string>{"kitchen", "scales"}));
  for (const char* const text : {"kitchen", "/a/../b", "/a?b", "/a?", "https://a/b"})
    EXPECT_FALSE(parse_base_path(text).ok()) << text;
}

}  // namespace
}  // namespace traygauge::test
