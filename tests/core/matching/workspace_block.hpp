// Memory for a workspace in tests: planned, taken, and checked.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <new>

#include "core/base/arena.hpp"

namespace traygauge {

template <class Workspace>
class WithMemory {
 public:
  template <class... Caps>
  explicit WithMemory(Caps... caps) {
    ArenaPlan plan;
    Workspace planned;
    planned.allocate(plan, caps...);
    bytes_ = plan.high_water_bytes();
    block_.reset(static_cast<std::byte*>(::operator new (bytes_, std::align_val_t{kArenaAlignmentBytes})));
    Arena arena({block_.get(), bytes_});
    workspace.allocate(arena, caps...);
    EXPECT_FALSE(arena.exhausted());
    EXPECT_EQ(arena.used_bytes(), bytes_);
  }
  std::size_t bytes() const { return bytes_; }

  Workspace workspace;

 private:
  struct Free {
    void operator()(std::byte* block) const {
      ::operator delete (block, std::align_val_t{kArenaAlignmentBytes});
    }
  };
  std::unique_ptr<std::byte, Free> block_;
  std::size_t bytes_ = 0;
};

}  // namespace traygauge
