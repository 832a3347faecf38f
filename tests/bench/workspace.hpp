// A stage's workspace with the memory that it plans.
#pragma once

#include "core/base/arena.hpp"
#include "firmware/base/aligned_block.hpp"

namespace traygauge::bench {

template <class Workspace>
class OwnedWorkspace {
 public:
  template <class... Caps>
  explicit OwnedWorkspace(const Caps&... caps) : block_(planned_bytes(caps...)) {
    Arena arena(block_.bytes());
    workspace_.allocate(arena, caps...);
  }
  Workspace& operator*() { return workspace_; }
  const Workspace& operator*() const { return workspace_; }

 private:
  template <class... Caps>
  static std::size_t planned_bytes(const Caps&... caps) {
    ArenaPlan plan;
    Workspace().allocate(plan, caps...);
    return plan.high_water_bytes();
  }

  AlignedBlock block_;
  Workspace workspace_;
};

}  // namespace traygauge::bench
