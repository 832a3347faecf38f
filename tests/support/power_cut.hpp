// Every state in which a power cut may leave a recorded disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/support/recorded_file_system.hpp"

namespace traygauge::test {

// A cut after the first `moment` operations. Of what was not synced by then, each sector of 512 bytes, each
// change of a file's size, and each change of names may be on the disk or not, whatever was written before or
// after it. A sector that was written twice never goes back to the first of both: the kernel keeps one copy.
class PowerCut {
 public:
  // `recorded` outlives the object.
  PowerCut(const RecordedFileSystem& recorded, std::size_t moment);

  // What may be there or not: 2^choice_count() states.
  std::size_t choice_count() const { return choice_count_; }
  // `is_kept` is asked for every choice from 0 on, in the order in which the program made the changes.
  DiskImage state(const std::function<bool(std::size_t choice)>& is_kept) const;
  // One of the ways in which disks fail: nothing or all kept, what came first, what came last, all but one
  // sector, single sectors, single operations, any subset.
  DiskImage sample(std::mt19937& random) const;

 private:
  enum class Fate { certain, open };
  std::size_t choices_of(const RecordedOperation& operation) const;

  const RecordedFileSystem& recorded_;
  std::vector<Fate> fates_;  // of the operations up to the moment
  std::vector<std::size_t> sizes_before_;
  std::size_t choice_count_ = 0;
};

// TRAYGAUGE_CRASH_POINTS, or `usual` where it is not set.
std::size_t crash_points(std::size_t usual);

}  // namespace traygauge::test
