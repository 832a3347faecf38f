// Memory that is taken once, aligned for the estimator's arena.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <span>

#include "core/base/arena.hpp"

namespace traygauge {

class AlignedBlock {
 public:
  explicit AlignedBlock(std::size_t bytes)
      : bytes_(static_cast<std::byte*>(::operator new (bytes, std::align_val_t{kArenaAlignmentBytes}))),
        size_(bytes) {}

  std::span<std::byte> bytes() const { return {bytes_.get(), size_}; }

 private:
  struct Release {
    void operator()(std::byte* bytes) const {
      ::operator delete (bytes, std::align_val_t{kArenaAlignmentBytes});
    }
  };
  std::unique_ptr<std::byte, Release> bytes_;
  std::size_t size_ = 0;
};

}  // namespace traygauge
