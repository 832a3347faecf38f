#include "core/base/arena.hpp"

#include <gtest/gtest.h>

#include <array>

namespace traygauge {
namespace {

struct Scratch {
  std::span<double> numbers;
  ImageView<std::uint8_t> picture;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, std::size_t count) {
    numbers = arena.template take<double>(count);
    picture = arena.template take_image<std::uint8_t>(10, 7);
  }
};

constexpr std::size_t planned_bytes(std::size_t count) {
  ArenaPlan plan;
  Scratch scratch;
  scratch.allocate(plan, count);
  return plan.high_water_bytes();
}

TEST(Arena, PlanIsKnownAtCompileTimeAndEqualsWhatIsTaken) {
  static_assert(planned_bytes(5) == 64 + 128);
  alignas(kArenaAlignmentBytes) std::array<std::byte, planned_bytes(5)> block{};
  Arena arena(block);
  Scratch scratch;
  scratch.allocate(arena, 5);
  EXPECT_FALSE(arena.exhausted());
  EXPECT_EQ(arena.used_bytes(), planned_bytes(5));
  EXPECT_EQ(scratch.numbers.size(), 5U);
}

TEST(Arena, SaysWhenTheBlockIsTooSmall) {
  alignas(kArenaAlignmentBytes) std::array<std::byte, 128> block{};
  Arena arena(block);
  Scratch scratch;
  scratch.allocate(arena, 5);
  EXPECT_TRUE(arena.exhausted());
  EXPECT_TRUE(scratch.picture.empty());
}

TEST(Arena, StagesShareMemoryBehindAMark) {
  alignas(kArenaAlignmentBytes) std::array<std::byte, 256> block{};
  Arena arena(block);
  const std::size_t mark = arena.mark();
  const auto first = arena.take<int>(16);
  arena.rewind(mark);
  const auto second = arena.take<float>(48);
  EXPECT_EQ(static_cast<void*>(first.data()), static_cast<void*>(second.data()));
  EXPECT_EQ(arena.high_water_bytes(), 192U);
}

}  // namespace
}  // namespace traygauge
