// The captures of one dish below TRAYGAUGE_CAPTURES.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "firmware/config/profile.hpp"
#include "simulator/capture/capture.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {

// A pair of views of such a capture.
struct NamedPair {
  std::filesystem::path folder;
  Capture capture;
  std::array<int, 2> views{};
};

// All pairs for the product, every third for profile paper.
inline std::vector<NamedPair> single_dish_pairs(Profile profile) {
  const std::size_t step = profile == Profile::best ? 1 : 3;
  std::vector<NamedPair> pairs;
  std::size_t seen = 0;
  for (const std::filesystem::path& folder : capture_folders()) {
    const Capture capture = read_capture(folder);
    if (capture.dishes.size() != 1) continue;
    for (const auto& views : capture.pairs) {
      if (seen++ % step == 0) pairs.push_back({folder, capture, views});
    }
  }
  return pairs;
}

}  // namespace traygauge
