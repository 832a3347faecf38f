// Ways to end as people and programs read them.
#include "core/base/status.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

namespace traygauge {
namespace {

TEST(StatusTexts, EachCodeHasANameOfItsOwnAndASentence) {
  std::set<std::string> names;
  std::set<std::string> sentences;
  for (std::size_t i = 0; i < kStatusCodeCount; ++i) {
    const auto code = static_cast<StatusCode>(i);
    const std::string text = sentence(code);
    EXPECT_TRUE(std::regex_match(name(code), std::regex("[a-z]+(_[a-z]+)*"))) << name(code);
    EXPECT_TRUE(std::regex_match(text, std::regex("[A-Z].{7,}\\."))) << text;
    names.insert(name(code));
    sentences.insert(text);
  }
  EXPECT_EQ(names.size(), kStatusCodeCount);
  EXPECT_EQ(sentences.size(), kStatusCodeCount);
  EXPECT_STREQ(name(StatusCode::ok), "ok");
  EXPECT_STREQ(name(StatusCode::item_textureless), "item_textureless");  // the last
}

TEST(StatusTexts, OnlyOkIsOk) {
  EXPECT_TRUE(Status().ok());
  for (std::size_t i = 0; i < kStatusCodeCount; ++i) {
    const Status status = static_cast<StatusCode>(i);
    EXPECT_EQ(status.ok(), status.code() == StatusCode::ok);
    EXPECT_EQ(status.code(), static_cast<StatusCode>(i));
  }
}

}  // namespace
}  // namespace traygauge
