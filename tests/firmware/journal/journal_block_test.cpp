#include "firmware/journal/journal_block.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "core/base/crc32c.hpp"
#include "core/base/little_endian.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

using Block = std::array<std::byte, kBlockBytes>;

constexpr std::uint64_t kId = 0x1122334455667788;
constexpr JournalHead kHead{kId, 16 * kBlockBytes, 5, {7, 3}, 9, 6};

Block block_of(const BlockHeader& header, std::size_t piece_bytes) {
  Block block{};
  encode_block(header, std::vector<std::byte>(piece_bytes, std::byte{'x'}), block);
  return block;
}

// As if the block had been written so.
void reseal(Block& block) {
  constexpr std::size_t kAt = kBlockBytes - kChecksumBytes;
  store_little_endian(std::span(block), kAt, crc32c(std::span(block).first(kAt)));
}

TEST(JournalBlock, ReadsBackWhatItWrote) {
  const BlockHeader header{kId, 17, {12, 4}, kBlockPayloadBytes + 5, 0xcafe, 1};
  const Block block = block_of(header, 5);
  const auto read = decode_block(block, kId);
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->sequence, 17U);
  EXPECT_EQ(read->oldest.sequence, 12U);
  EXPECT_EQ(read->oldest.block, 4U);
  EXPECT_EQ(read->payload_bytes, kBlockPayloadBytes + 5);
  EXPECT_EQ(read->payload_crc, 0xcafeU);
  EXPECT_EQ(read->part, 1);
  const auto piece = piece_of(*read, block);
  EXPECT_EQ(std::vector(piece.begin(), piece.end()), std::vector(5, std::byte{'x'}));
}

TEST(JournalBlock, ARecordTakesABlockForEach4048Bytes) {
  EXPECT_EQ(kBlockPayloadBytes, 4048U);
  EXPECT_EQ(blocks_of(0), 1U);
  EXPECT_EQ(blocks_of(kBlockPayloadBytes), 1U);
  EXPECT_EQ(blocks_of(kBlockPayloadBytes + 1), 2U);
  EXPECT_EQ(blocks_of(kMaxPayloadBytes), 17U);
}

TEST(JournalBlock, EveryFlippedBitIsSeen) {
  const Block record = block_of({kId, 17, {12, 4}, 100, 0xcafe, 0}, 100);
  Block head{};
  encode_head(kHead, head);
  JournalHead unused;
  for (std::size_t bit = 0; bit < kBlockBytes * 8; bit += bit < 1200 ? 1 : 61) {
    const auto flip = static_cast<std::byte>(1U << (bit % 8));
    Block damaged = record;
    damaged[bit / 8] ^= flip;
    EXPECT_FALSE(decode_block(damaged, kId)) << bit;
    damaged = head;
    damaged[bit / 8] ^= flip;
    EXPECT_NE(decode_head(damaged, unused), HeadState::intact) << bit;
  }
}

TEST(JournalBlock, ABlockOfAnotherJournalIsNone) {
  EXPECT_FALSE(decode_block(block_of({kId, 17, {12, 4}, 100, 0xcafe, 0}, 100), kId + 1));
}

// A checksum is no proof that a program wrote the block.
TEST(JournalBlock, ImpossibleSizesAndPartsAreRefused) {
  constexpr std::size_t kPartAt = 4;
  constexpr std::size_t kPayloadBytesAt = 36;
  Block block = block_of({kId, 17, {12, 4}, 100, 0xcafe, 0}, 100);
  store_little_endian(std::span(block), kPartAt, std::uint16_t{1});
  reseal(block);
  EXPECT_FALSE(decode_block(block, kId));
  store_little_endian(std::span(block), kPartAt, std::uint16_t{0});
  store_little_endian(std::span(block), kPayloadBytesAt, std::uint32_t{kMaxPayloadBytes + 1});
  reseal(block);
  EXPECT_FALSE(decode_block(block, kId));
}

TEST(JournalBlock, AHeadSaysWhatItIs) {
  Block block{};
  JournalHead read;
  encode_head(kHead, block);
  ASSERT_EQ(decode_head(block, read), HeadState::intact);
  EXPECT_EQ(read.journal_id, kHead.journal_id);
  EXPECT_EQ(read.file_bytes, kHead.file_bytes);
  EXPECT_EQ(read.generation, kHead.generation);
  EXPECT_EQ(read.oldest.sequence, kHead.oldest.sequence);
  EXPECT_EQ(read.oldest.block, kHead.oldest.block);
  EXPECT_EQ(read.next_sequence, kHead.next_sequence);
  EXPECT_EQ(read.next_block, kHead.next_block);
  constexpr std::size_t kVersionAt = 8;
  store_little_endian(std::span(block), kVersionAt, std::uint32_t{2});
  EXPECT_EQ(decode_head(block, read), HeadState::newer_version);
  block.fill(std::byte{0});
  EXPECT_EQ(decode_head(block, read), HeadState::foreign);
}

// Bytes of a head in an order that every processor shares, because a card moves from board to board.
TEST(JournalBlock, NumbersAreLittleEndian) {
  Block block{};
  encode_head(kHead, block);
  constexpr std::string_view kMagic = "TRAYJRNL";
  for (std::size_t i = 0; i < kMagic.size(); ++i) {
    EXPECT_EQ(std::to_integer<char>(block[i]), kMagic[i]);
  }
  EXPECT_EQ(block[16], std::byte{0x88});
  EXPECT_EQ(block[23], std::byte{0x11});
}

}  // namespace
}  // namespace traygauge::test
