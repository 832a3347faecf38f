#include "core/paper/matching/packed_descriptors.hpp"

#include <algorithm>

namespace traygauge::paper {

namespace {

// Farther from every unit vector than any of them is from another.
constexpr float kPadValue = 1e3F;

}  // namespace

void assign_slots(std::span<const Keypoint> keypoints, PackedDescriptors& packed) {
  std::size_t slot = 0;
  for (int group = 0; group < kSignGroups; ++group) {
    packed.group_begin[static_cast<std::size_t>(group)] = static_cast<int>(slot / kBlockSize);
    for (std::size_t i = 0; i < keypoints.size(); ++i) {
      if (sign_group(keypoints[i].laplacian) == group) packed.slots[slot++] = static_cast<std::int32_t>(i);
    }
    while (slot % kBlockSize != 0) packed.slots[slot++] = -1;
  }
  packed.group_begin[kSignGroups] = static_cast<int>(slot / kBlockSize);
}

void fill_blocks(std::span<const Descriptor> descriptors, PackedDescriptors& packed) {
  const auto slots = static_cast<std::size_t>(packed.group_begin[kSignGroups]) * kBlockSize;
  for (std::size_t slot = 0; slot < slots; ++slot) {
    float* place = packed.values.data() + slot / kBlockSize * kBlockFloats + slot % kBlockSize;
    const std::int32_t feature = packed.slots[slot];
    for (std::size_t d = 0; d < kDescriptorLength; ++d) {
      place[d * kBlockSize] = feature < 0 ? kPadValue : descriptors[static_cast<std::size_t>(feature)][d];
    }
  }
}

}  // namespace traygauge::paper
