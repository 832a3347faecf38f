#include "firmware/config/lens_table.hpp"

#include <array>
#include <optional>
#include <string_view>

#include "simulator/capture/calibration_file.hpp"
#include "simulator/capture/json_node.hpp"
#include "simulator/capture/toml_file.hpp"

namespace traygauge {
namespace {

constexpr int kMaxFocus = 10'000'000;
constexpr std::array<std::string_view, 12> kLensKeys = {
    "file",  "width",  "height",        "fx",           "fy", "cx", "cy", "distortion",
    "focus", "camera", "calibrated_on", "grade_percent"};

// A day, as TOML's dates are written, but in quotes.
std::string read_day(const JsonNode& node) {
  std::string day = node.text();
  bool is_day = day.size() == 10 && day[4] == '-' && day[7] == '-';
  for (std::size_t i = 0; is_day && i < day.size(); ++i)
    is_day = i == 4 || i == 7 || (day[i] >= '0' && day[i] <= '9');
  if (!is_day) node.fail("a day such as \"2025-01-31\"", "correct the value");
  return day;
}

// The values of a [lens] table, or of the calibration file that it names.
CameraDescription read_lens_values(const JsonNode& table, PictureSize mode,
                                   const std::filesystem::path& folder) {
  CameraDescription camera;
  camera.size = mode;
  if (const auto width = table.find("width"))
    camera.size.width = width->integer(kMinPictureSide, kMaxPictureSide);
  if (const auto height = table.find("height"))
    camera.size.height = height->integer(kMinPictureSide, kMaxPictureSide);
  if (const auto file = table.find("file")) {
    for (const char* value : {"fx", "fy", "cx", "cy", "distortion"}) {
      if (const auto node = table.find(value))
        node->fail("no value beside file, which has it", "remove one of the two");
    }
    const bool has_size = table.find("width") || table.find("height");
    const InputFile place{folder / file->text(), file->key()};
    camera = read_calibration_file(place, has_size ? std::optional(camera.size) : std::nullopt);
    check_camera({place.path, ""}, camera);
    return camera;
  }
  read_camera_values(table, {0.0, camera.size.width - 1.0}, {0.0, camera.size.height - 1.0}, camera);
  check_camera({table.file(), table.key()}, camera);
  return camera;
}

}  // namespace

LensConfig read_lens_table(const JsonNode& table, const JsonNode& camera_table,
                           const V4l2CameraParams& camera, const std::filesystem::path& folder) {
  expect_keys(table, kLensKeys);
  LensConfig lens;
  lens.camera = read_lens_values(table, {camera.mode.width, camera.mode.height}, folder);
  if (const auto focus = table.find("focus")) lens.focus = focus->integer(-kMaxFocus, kMaxFocus);
  if (const auto name = table.find("camera")) lens.calibrated_camera = name->text();
  if (const auto day = table.find("calibrated_on")) lens.calibrated_on = read_day(*day);
  if (const auto grade = table.find("grade_percent"))
    lens.grade_percent = grade->number({0.0, kMaxGradePercent});
  if (const auto day = camera_table.find("lens_changed_on")) lens.changed_on = read_day(*day);
  return lens;
}

}  // namespace traygauge
