// The captures of one dish below TRAYGAUGE_CAPTURES.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "simulator/capture/capture.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {

struct NamedCapture {
  std::filesystem::path folder;
  Capture capture;
};

inline std::vector<NamedCapture> single_dish_captures() {
  std::vector<NamedCapture> captures;
  for (const std::filesystem::path& folder : capture_folders()) {
    Capture capture = read_capture(folder);
    if (capture.dishes.size() == 1) captures.push_back({folder, std::move(capture)});
  }
  return captures;
}

// One of its pairs.
struct NamedPair {
  std::filesystem::path folder;
  Capture capture;
  std::array<int, 2> views{};
};

// Every `step`th pair of them all.
inline std::vector<NamedPair> single_dish_pairs(std::size_t step) {
  std::vector<NamedPair> pairs;
  std::size_t seen = 0;
  for (const auto& [folder, capture] : single_dish_captures()) {
    for (const auto& views : capture.pairs) {
      if (seen++ % step == 0) pairs.push_back({folder, capture, views});
    }
  }
  return pairs;
}

}  // namespace traygauge
