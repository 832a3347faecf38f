// A capture: a folder with pictures of a tray and capture.json, which describes them.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "simulator/capture/camera_description.hpp"
#include "simulator/capture/dish_description.hpp"
#include "simulator/capture/input_error.hpp"
#include "simulator/capture/input_warning.hpp"
#include "simulator/capture/picture.hpp"

namespace traygauge {

// The reference card; its print lies `thickness_mm` above the table.
struct CardDescription {
  InputFile pattern;
  double width_mm = 0.0;
  double height_mm = 0.0;
  double thickness_mm = 0.0;
};

struct ViewDescription {
  InputFile image;
  std::optional<InputFile> labels;
  std::optional<double> arm_angle_deg;
  CameraDescription
      camera;              // its own, or the capture's; for pictures of the image's size where it can be read
  InputFile camera_place;  // where that is given: in capture.json, or in a file of its own
  std::vector<InputWarning> warnings;  // about the camera
};

struct Capture {
  std::filesystem::path file;  // capture.json
  CardDescription card;
  std::vector<DishDescription> dishes;  // empty: to be chosen from config/dishes
  std::vector<ViewDescription> views;
  std::vector<std::array<int, 2>> pairs;
};

// Reads capture.json of `folder`; pictures are not opened yet. Throws InputError.
Capture read_capture(const std::filesystem::path& folder);

// A view's pixels and, when it has them, labels (else an empty picture), at its camera's size.
struct LoadedView {
  Picture picture;
  Picture labels;
  std::vector<InputWarning> warnings;
};
LoadedView load_view(const ViewDescription& view);

// The card's printed side in grey.
Picture load_pattern(const CardDescription& card);

}  // namespace traygauge
