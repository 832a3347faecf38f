// Warnings as people and programs read them, and what they are about.
#include "core/quality/warning.hpp"

#include <gtest/gtest.h>

#include <random>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

TEST(Warning, EachHasANameOfItsOwnAndASentence) {
  std::set<std::string> names;
  std::set<std::string> sentences;
  for (std::size_t i = 0; i < kWarningCount; ++i) {
    const auto warning = static_cast<Warning>(i);
    EXPECT_TRUE(std::regex_match(name(warning), std::regex("[a-z]+(_[a-z]+)*"))) << name(warning);
    const std::string text = sentence(warning);
    EXPECT_TRUE(std::regex_match(text, std::regex("[A-Z].{20,}\\."))) << text;
    names.insert(name(warning));
    sentences.insert(text);
  }
  EXPECT_EQ(names.size(), kWarningCount);
  EXPECT_EQ(sentences.size(), kWarningCount);
  EXPECT_STREQ(name(Warning::blurred), "blurred");
  EXPECT_STREQ(name(Warning::items_doubtful), "items_doubtful");
}

TEST(Warning, SetsHoldWhatWasRaisedAndForWhat) {
  std::mt19937 random(test::random_seed());
  std::uniform_int_distribution<std::size_t> any(0, kWarningCount - 1);
  std::uniform_int_distribution<int> label(0, 255);
  WarningSet set;
  EXPECT_TRUE(set.empty());
  set.raise_if(false, Warning::blurred);
  EXPECT_TRUE(set.empty());
  std::set<std::pair<int, int>> truth;
  for (int i = 0; i < 60; ++i) {
    const std::size_t which = any(random);
    const int about = i % 3 == 0 ? 0 : label(random);
    set.raise(static_cast<Warning>(which), static_cast<std::uint8_t>(about));
    truth.insert({static_cast<int>(which), about});
  }
  std::vector<std::pair<int, int>> told;
  set.for_each(
      [&](Warning warning, std::uint8_t about) { told.emplace_back(static_cast<int>(warning), about); });
  EXPECT_EQ(told, std::vector(truth.begin(), truth.end()));  // in order
  for (std::size_t i = 0; i < kWarningCount; ++i) {
    bool any_of_it = false;
    for (int about = 0; about < 256; ++about) {
      const bool is_raised = truth.contains({static_cast<int>(i), about});
      EXPECT_EQ(set.holds(static_cast<Warning>(i), static_cast<std::uint8_t>(about)), is_raised);
      any_of_it = any_of_it || is_raised;
    }
    EXPECT_EQ(set.holds(static_cast<Warning>(i)), any_of_it);
  }
}

}  // namespace
}  // namespace traygauge
