// Memory for a workspace in a test: as much as its own plan asks for.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <new>

#include "core/base/arena.hpp"

namespace traygauge::test {

// The arguments are those of Workspace::allocate after the memory.
template <class Workspace>
class Allocated {
 public:
  template <class... Caps>
  explicit Allocated(Caps... caps) {
    ArenaPlan plan;
    Workspace planned;
    planned.allocate(plan, caps...);
    bytes_ = plan.high_water_bytes();
    block_.reset(static_cast<std::byte*>(::operator new (bytes_, std::align_val_t{kArenaAlignmentBytes})));
    Arena arena({block_.get(), bytes_});
    workspace_.allocate(arena, caps...);
    EXPECT_FALSE(arena.exhausted());
  }

  Workspace& operator*() { return workspace_; }
  Workspace* operator->() { return &workspace_; }
  std::size_t bytes() const { return bytes_; }

 private:
  struct Free {
    void operator()(std::byte* block) const {
      ::operator delete (block, std::align_val_t{kArenaAlignmentBytes});
    }
  };
  std::unique_ptr<std::byte, Free> block_;
  std::size_t bytes_ = 0;
  Workspace workspace_;
};

}  // namespace traygauge::test
