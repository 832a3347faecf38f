// Memory for a workspace in a test.
#pragma once

#include <cstddef>
#include <new>
#include <span>

#include "core/base/arena.hpp"

namespace traygauge::testing {

// A workspace with the memory that its own plan asks for.
template <class Workspace>
class Allocated {
 public:
  template <class... Caps>
  explicit Allocated(Caps... caps) {
    ArenaPlan plan;
    Workspace planned;
    planned.allocate(plan, caps...);
    bytes_ = plan.high_water_bytes();
    block_ = static_cast<std::byte*>(::operator new (bytes_, std::align_val_t{kArenaAlignmentBytes}));
    Arena arena(std::span<std::byte>(block_, bytes_));
    workspace_.allocate(arena, caps...);
  }
  ~Allocated() { ::operator delete (block_, std::align_val_t{kArenaAlignmentBytes}); }
  Allocated(const Allocated&) = delete;
  Allocated& operator=(const Allocated&) = delete;

  Workspace& operator*() { return workspace_; }
  Workspace* operator->() { return &workspace_; }
  std::size_t bytes() const { return bytes_; }

 private:
  std::byte* block_ = nullptr;
  std::size_t bytes_ = 0;
  Workspace workspace_;
};

}  // namespace traygauge::testing
