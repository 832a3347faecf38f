// Whatever happens to capture.json, the reader answers with a capture or with InputError.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>

#include "simulator/capture/capture.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

// True when the text was accepted. Any other exception fails the test.
bool is_accepted(const TemporaryCapture& files, const std::string& text) {
  write_text(files.file("capture.json"), text);
  try {
    read_capture(files.folder());
    return true;
  } catch (const InputError&) {
    return false;
  }
}

TEST(CaptureFuzz, NoTruncationIsAccepted) {
  const TemporaryCapture files;
  const std::string whole = files.document.dump();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(is_accepted(files, whole.substr(0, size))) << "cut to " << size;
  }
  EXPECT_TRUE(is_accepted(files, whole));
}

TEST(CaptureFuzz, DamagedBytesAreAcceptedOrNamed) {
  const TemporaryCapture files;
  const std::string whole = files.document.dump();
  std::mt19937 random(test::random_seed());
  int refused = 0;
  for (int round = 0; round < 1500; ++round) {
    std::string damaged = whole;
    const unsigned flips = 1 + random() % 4;
    for (unsigned i = 0; i < flips; ++i) damaged[random() % damaged.size()] = static_cast<char>(random());
    refused += is_accepted(files, damaged) ? 0 : 1;
  }
  EXPECT_GT(refused, 750);
}

TEST(CaptureFuzz, TokensInTheWrongPlaceAreAcceptedOrNamed) {
  constexpr std::array<const char*, 14> tokens = {
      "null", "-1",  "1e308", "1e999",   "\"\"",   "[]",    "{}",
      "true", "[[]", "0.5",   "\\u0000", "\"..\"", "\"/\"", "99999999999999999999"};
  const TemporaryCapture files;
  const std::string whole = files.document.dump();
  std::mt19937 random(test::random_seed());
  int refused = 0;
  for (int round = 0; round < 1500; ++round) {
    std::string damaged = whole;
    const std::size_t colon = damaged.find_first_of(":,[", random() % damaged.size());
    if (colon == std::string::npos) continue;
    const std::size_t end = damaged.find_first_of(",]}", colon + 1);
    damaged.replace(colon + 1, end - colon - 1, tokens[random() % tokens.size()]);
    refused += is_accepted(files, damaged) ? 0 : 1;
  }
  EXPECT_GT(refused, 750);
}

}  // namespace
}  // namespace traygauge
