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

struct Stages {
  std::span<int> first;
  std::span<float> second;
  std::span<std::uint8_t> behind;

  template <class Allocator>
  constexpr void allocate(Allocator& arena) {
    arena.overlay([&] { first = arena.template take<int>(48); },
                  [&] { second = arena.template take<float>(16); });
    behind = arena.template take<std::uint8_t>(1);
  }
};

// The plan counts what the arena takes, and what follows begins behind the largest part.
TEST(Arena, StagesShareTheMemoryOfTheLargest) {
  ArenaPlan plan;
  Stages().allocate(plan);
  EXPECT_EQ(plan.high_water_bytes(), 192U + 64U);
  alignas(kArenaAlignmentBytes) std::array<std::byte, 256> block{};
  Arena arena(block);
  Stages stages;
  stages.allocate(arena);
  EXPECT_EQ(static_cast<void*>(stages.first.data()), static_cast<void*>(stages.second.data()));
  EXPECT_EQ(static_cast<void*>(stages.behind.data()), static_cast<void*>(&block[192]));
  EXPECT_EQ(arena.high_water_bytes(), plan.high_water_bytes());
  EXPECT_FALSE(arena.exhausted());
}

}  // namespace
}  // namespace traygauge
