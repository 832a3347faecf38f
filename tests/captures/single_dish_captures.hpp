// The captures of one dish below TRAYGAUGE_CAPTURES.
#pragma once

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

}  // namespace traygauge
