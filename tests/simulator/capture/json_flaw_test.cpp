// What is said of a file that is not quite JSON: where, what stands there, what to do.
#include "simulator/capture/json_flaw.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <string>

#include "simulator/capture/input_error.hpp"
#include "simulator/capture/json_file.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

struct FlawedText {
  const char* name;
  std::function<std::string(std::string)> spoil;
  const char* found;  // with the place
  const char* hint;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

// As Windows' editors save it: two bytes a character, the lower first.
std::string utf16(const std::string& text) {
  std::string wide = "\xFF\xFE";
  for (const char c : text) {
    wide += c;
    wide += '\0';
  }
  return wide;
}

const char* const kWhole = "{\n \"a\": {\"cx\": 806.3,\n  \"cy\": [1, 2]}\n}\n";

class JsonFlaws : public testing::TestWithParam<FlawedText> {};

TEST_P(JsonFlaws, AreNamedWithTheirPlace) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "flawed.json";
  write_text(file, GetParam().spoil(kWhole));
  try {
    read_json(file);
    ADD_FAILURE() << GetParam().name;
  } catch (const InputError& error) {
    EXPECT_EQ(error.problem().found, GetParam().found) << error.what();
    EXPECT_NE(error.problem().hint.find(GetParam().hint), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("flawed.json:" + std::to_string(error.problem().line)),
              std::string::npos);
  }
}

std::function<std::string(std::string)> put(const char* from, const char* to) {
  return [from, to](const std::string& text) { return replaced(text, from, to); };
}

INSTANTIATE_TEST_SUITE_P(
    Each, JsonFlaws,
    testing::Values(
        FlawedText{"nan", put("806.3", "NaN"), "NaN in line 2, column 14", "finite"},
        FlawedText{"infinity", put("806.3", "-Infinity"), "-Infinity in line 2, column 14", "finite"},
        FlawedText{"overflow", put("[1, 2]", "[1, 1e400]"), "1e400 in line 3, column 13", "finite"},
        FlawedText{"overflow behind a text", put("\"cy\": [1, 2]", "\"1e999\": -1e999"),
                   "-1e999 in line 3, column 12", "finite"},
        FlawedText{"decimal comma", put("806.3", "806,3"), "806,3 in line 2, column 14", "806.3"},
        FlawedText{"comment", put("{\n", "{ // ours\n"), "the comment // ours in line 1, column 3",
                   "comments"},
        FlawedText{"long comment", put("[1", "[/* one */ 1"),
                   "the comment /* one */ 1, 2]} in line 3, column 10", "comments"},
        FlawedText{"hash", put("\n}", "\n# end\n}"), "the comment # end in line 4, column 1", "comments"},
        FlawedText{"comma before a brace", put("2]}", "2],\n }"), "a comma before } in line 3, column 15",
                   "remove"},
        FlawedText{"comma before a bracket", put("2]", "2,]"), "a comma before ] in line 3, column 14",
                   "remove"},
        FlawedText{"Python", put("806.3", "None"), "None in line 2, column 14", "null"},
        FlawedText{"quotes", put("\"cx\"", "'cx'"), "a single quote in line 2, column 8", "double"},
        FlawedText{"no comma", put("[1, 2]", "[1 2]"), "2 in line 3, column 12", "commas"},
        FlawedText{"after an umlaut", put("{\"cx\": 806.3", "{\"\xC3\xA4\": NaN"), "NaN in line 2, column 13",
                   "finite"},
        FlawedText{"Latin-1", put("\"a\"", "\"\xE4\""),
                   "a byte that is no UTF-8, or a sign that belongs in quotes in line 2, column 3", "UTF-8"},
        FlawedText{"UTF-16", utf16, "UTF-16 in line 1, column 1", "UTF-8"},
        FlawedText{"cut", [](const std::string& text) { return text.substr(0, 30); },
                   "the end of the file in line 3, column 9", "brackets"},
        FlawedText{"empty", [](const std::string&) { return std::string(); },
                   "an empty file in line 1, column 1", "write"},
        FlawedText{"blank", [](const std::string&) { return std::string(" \n\n"); },
                   "an empty file in line 1, column 1", "write"}),
    [](const auto& each) {
      std::string name = each.param.name;
      std::erase_if(name, [](char c) { return c == ' ' || c == '-'; });
      return name;
    });

// Whatever stands there, the place lies within the text.
TEST(JsonFlaw, AnyByteMayBeTheWrongOne) {
  std::mt19937 random(test::random_seed());
  const TemporaryFolder folder;
  const auto file = folder.path() / "flawed.json";
  int refused = 0;
  for (int round = 0; round < 1000; ++round) {
    std::string text = kWhole;
    for (unsigned i = 0; i <= random() % 3; ++i) text[random() % text.size()] = static_cast<char>(random());
    write_text(file, text);
    try {
      read_json(file);
    } catch (const InputError& error) {
      ++refused;
      EXPECT_GE(error.problem().line, 1);
      EXPECT_LE(error.problem().line, 1 + std::count(text.begin(), text.end(), '\n'));
      EXPECT_FALSE(error.problem().found.empty());
    }
  }
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace traygauge
