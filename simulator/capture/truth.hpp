// truth.json of a capture: what a measurement is compared with. `measure` never reads it.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace traygauge {

struct TruthItem {
  int label = 0;
  std::string name;
  std::string kind = "heightfield";  // or "scan": overhangs, and its volume is closed
  double volume_ml = 0.0;
  std::optional<double> volume_above_bottom_plane_ml;
  std::optional<double> column_volume_ml;  // under the upper surface, of a scan
};

using WorldToCamera = std::array<std::array<double, 4>, 4>;  // mm, OpenCV axes, last row 0 0 0 1

// Where a dish stands.
struct TruthDish {
  int label = 1;
  std::array<double, 2> centre_mm{};  // in the world
  double rotation_deg = 0.0;          // of outer_size_mm[0] from the world's x towards its y
};

struct Truth {
  std::vector<TruthItem> items;
  std::vector<TruthDish> dishes;     // none: one, under the world's origin
  std::vector<WorldToCamera> poses;  // one a view
};

// Nothing when the capture has no truth.json; InputError when it has an unreadable one.
std::optional<Truth> read_truth(const std::filesystem::path& capture_folder);

}  // namespace traygauge
