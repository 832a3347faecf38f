#include "firmware/handover/message.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

std::string random_bytes(std::mt19937& random, std::size_t max_bytes) {
  std::string bytes(std::uniform_int_distribution<std::size_t>(0, max_bytes)(random), '\0');
  std::generate(bytes.begin(), bytes.end(), [&random] { return static_cast<char>(random() & 0xFFU); });
  return bytes;
}

Message random_message(std::mt19937& random) {
  constexpr int kLastType = static_cast<int>(MessageType::drift);
  const auto type = static_cast<MessageType>(std::uniform_int_distribution<int>(0, kLastType)(random));
  return {type, random_bytes(random, 300), random_bytes(random, 300)};
}

TEST(MessageReader, PutsMessagesTogetherHoweverTheyAreCut) {
  std::mt19937 random(random_seed());
  for (int run = 0; run < 200; ++run) {
    std::vector<Message> sent(10);
    std::generate(sent.begin(), sent.end(), [&random] { return random_message(random); });
    std::string stream;
    for (const Message& message : sent) stream += encode(message);
    MessageReader reader;
    std::vector<Message> read;
    for (std::size_t at = 0; at < stream.size();) {
      const std::size_t piece = std::uniform_int_distribution<std::size_t>(1, 400)(random);
      reader.append(std::string_view(stream).substr(at, piece));
      at += piece;
      for (;;) {
        auto next = reader.next();
        ASSERT_TRUE(next.ok()) << next.failure();
        if (!*next) break;
        read.push_back(**next);
      }
    }
    ASSERT_EQ(read, sent);
    ASSERT_FALSE(reader.holds_part());
  }
}

TEST(MessageReader, SaysWhatElseItFound) {
  MessageReader web;
  web.append("GET / HTTP/1.1\r\n");
  EXPECT_FALSE(web.next().ok());

  std::string newer = encode({MessageType::hello, "{}", {}});
  newer[3] = '2';
  MessageReader reader;
  reader.append(newer);
  EXPECT_FALSE(reader.next().ok());

  std::string unknown = encode({MessageType::hello, "{}", {}});
  unknown[4] = static_cast<char>(200);
  MessageReader kinds;
  kinds.append(unknown);
  const auto next = kinds.next();
  ASSERT_FALSE(next.ok());
  EXPECT_NE(next.failure().find("200"), std::string::npos) << next.failure();
}

// A length of gigabytes must not make the reader wait for them.
TEST(MessageReader, RefusesLengthsBeyondTheLimits) {
  for (const std::size_t first_length_byte : {5U, 9U}) {
    std::string huge = encode({MessageType::scan, "{}", {}});
    huge[first_length_byte + 3] = '\x7f';
    MessageReader reader;
    reader.append(huge);
    EXPECT_FALSE(reader.next().ok()) << first_length_byte;
  }
  Message largest{MessageType::scan, std::string(kMaxTextBytes, 'x'), std::string(kMaxBodyBytes, 'y')};
  MessageReader reader;
  reader.append(encode(largest));
  const auto next = reader.next();
  ASSERT_TRUE(next.ok() && *next);
  EXPECT_EQ(**next, largest);
}

TEST(MessageReader, NamesAnotherVersionOfTheFormat) {
  for (const auto& [beginning, found] :
       {std::pair{"TGM2", "found format 2: install station and hub of one version"},
        std::pair{"TGMx", "found something else"}, std::pair{"GET ", "found something else"}}) {
    std::string other = encode({MessageType::scan, "{}", {}});
    other.replace(0, 4, beginning);
    MessageReader reader;
    reader.append(other);
    const auto next = reader.next();
    ASSERT_FALSE(next.ok()) << beginning;
    EXPECT_NE(next.failure().find(found), std::string::npos) << next.failure();
  }
}

TEST(MessageReader, NeverCrashesOnDamage) {
  std::mt19937 random(random_seed());
  int refused = 0;
  for (int run = 0; run < 20000; ++run) {
    std::string stream = encode(random_message(random)) + encode(random_message(random));
    for (int flips = 0; flips < 3; ++flips)
      stream[std::uniform_int_distribution<std::size_t>(0, stream.size() - 1)(random)] ^=
          static_cast<char>(1U << (random() % 8));
    MessageReader reader;
    reader.append(stream);
    for (auto next = reader.next();; next = reader.next()) {
      if (!next.ok()) ++refused;
      if (!next.ok() || !*next) break;
      ASSERT_LE((*next)->text.size(), stream.size());
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace traygauge::test
