// The one block of memory of a measurement, and its planner. Workspaces are written once as
// `template <class Allocator> constexpr void allocate(Allocator&, caps…)`; run with an ArenaPlan they yield
// the byte count (also at compile time), run with an Arena they yield the memory.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

#include "core/image_view/image_view.hpp"

namespace traygauge {

inline constexpr std::size_t kArenaAlignmentBytes = 64;  // a cache line, and any SIMD vector of today

constexpr std::size_t aligned_bytes(std::size_t bytes) {
  return (bytes + kArenaAlignmentBytes - 1) / kArenaAlignmentBytes * kArenaAlignmentBytes;
}

// Counts what a workspace would take; hands out empty spans.
class ArenaPlan {
 public:
  template <class T>
  constexpr std::span<T> take(std::size_t count) {
    used_ += aligned_bytes(count * sizeof(T));
    high_water_ = used_ > high_water_ ? used_ : high_water_;
    return {};
  }
  template <class T>
  constexpr ImageView<T> take_image(int width, int height) {
    take<T>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    return {nullptr, width, height};
  }
  // Stages that never work at the same time share memory: each of `parts`, a call that takes from this arena,
  // begins where this one begins, and as much as the largest needs stays taken.
  template <class... Parts>
  constexpr void overlay(Parts&&... parts) {
    const std::size_t begin = used_;
    std::size_t end = begin;
    const auto lay = [&](auto&& part) {
      used_ = begin;
      part();
      end = used_ > end ? used_ : end;
    };
    (lay(parts), ...);
    used_ = end;
  }
  constexpr std::size_t used_bytes() const { return used_; }
  constexpr std::size_t high_water_bytes() const { return high_water_; }

 private:
  std::size_t used_ = 0;
  std::size_t high_water_ = 0;
};

// Hands out pieces of a block that the caller owns, in order, never freed one by one.
class Arena {
 public:
  Arena() = default;
  // `block` must be aligned to kArenaAlignmentBytes.
  explicit Arena(std::span<std::byte> block) : block_(block) {}

  // `count` value-initialised objects. Empty, and exhausted() from then on, when the block is too small.
  template <class T>
  std::span<T> take(std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T>, "the arena never runs destructors");
    static_assert(alignof(T) <= kArenaAlignmentBytes);
    const std::size_t bytes = aligned_bytes(count * sizeof(T));
    if (bytes > block_.size() - used_) {
      exhausted_ = true;
      return {};
    }
    auto* first = reinterpret_cast<T*>(block_.data() + used_);
    used_ += bytes;
    high_water_ = used_ > high_water_ ? used_ : high_water_;
    std::uninitialized_value_construct_n(first, count);
    return {std::launder(first), count};
  }
  template <class T>
  ImageView<T> take_image(int width, int height) {
    auto pixels = take<T>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    if (pixels.empty()) return {};
    return {pixels.data(), width, height};
  }
  // Stages that never work at the same time share memory: each of `parts`, a call that takes from this arena,
  // begins where this one begins, and as much as the largest needs stays taken.
  template <class... Parts>
  void overlay(Parts&&... parts) {
    const std::size_t begin = used_;
    std::size_t end = begin;
    const auto lay = [&](auto&& part) {
      used_ = begin;
      part();
      end = used_ > end ? used_ : end;
    };
    (lay(parts), ...);
    used_ = end;
  }
  std::size_t used_bytes() const { return used_; }
  std::size_t high_water_bytes() const { return high_water_; }
  bool exhausted() const { return exhausted_; }

 private:
  std::span<std::byte> block_;
  std::size_t used_ = 0;
  std::size_t high_water_ = 0;
  bool exhausted_ = false;
};

}  // namespace traygauge
