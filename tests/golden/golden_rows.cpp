#include "tests/golden/golden_rows.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cstdio>
#include <sstream>

#include "firmware/config/dish_choice.hpp"
#include "firmware/measure/capture_session.hpp"
#include "simulator/capture/capture.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge::golden {
namespace {

constexpr std::uint64_t kSeed = 1;

// Release builds agree on these decimals, whether their sources are merged or not.
constexpr int kVolumeDecimals = 6;       // ml
constexpr int kTranslationDecimals = 6;  // mm
constexpr int kRotationDecimals = 9;     // rad

std::string decimals(double value, int count) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", count, value);
  return text.data();
}

void write_pose(const Measurement& measurement, std::ostream& row) {
  if (!measurement.has_pose) {
    row << ",,,,,,";
    return;
  }
  const Pose& pose = measurement.second_from_first;
  const Eigen::AngleAxisd turn(pose.rotation);
  const Vec3 rotation = turn.angle() * turn.axis();
  for (const double value : rotation) row << decimals(value, kRotationDecimals) << ',';
  for (const double value : pose.translation) row << decimals(value, kTranslationDecimals) << ',';
}

void write_warnings(const Measurement& measurement, std::ostream& row) {
  const char* separator = "";
  measurement.warnings.for_each([&](Warning warning, std::uint8_t label) {
    row << separator << name(warning);
    if (label != kBackgroundLabel) row << ':' << int{label};
    separator = " ";
  });
}

void write_item(const ItemResult& item, std::ostream& row) {
  row << int{item.label} << ',' << int{item.dish} << ',' << name(item.status) << ',';
  if (item.status == StatusCode::ok) {
    row << decimals(item.volume_ml, kVolumeDecimals) << ',' << decimals(item.sigma_ml, kVolumeDecimals);
  } else {
    row << ',';
  }
  row << ",,,,,,,";
}

void append_rows(const std::string& capture, std::array<int, 2> pair, const Measurement& measurement,
                 std::vector<std::string>& rows) {
  const auto begin_row = [&](std::ostream& row) {
    row << capture << ',' << pair[0] << '-' << pair[1] << ',';
  };
  std::ostringstream whole;
  begin_row(whole);
  whole << ",," << name(measurement.status.code()) << ",,,";
  write_pose(measurement, whole);
  write_warnings(measurement, whole);
  rows.push_back(whole.str());
  for (const ItemResult& item : measurement.items) {
    std::ostringstream row;
    begin_row(row);
    write_item(item, row);
    rows.push_back(row.str());
  }
}

}  // namespace

std::string header_row() {
  return "capture,pair,label,dish,status,volume_ml,sigma_ml,rotation_x_rad,rotation_y_rad,rotation_z_rad,"
         "translation_x_mm,translation_y_mm,translation_z_mm,warnings";
}

std::vector<std::string> measure_rows(const std::filesystem::path& folder, const Route& route) {
  std::vector<std::string> rows;
  ProfileParameters parameters;
  parameters.profile = route.profile;
  for (const std::filesystem::path& path : capture_folders(folder)) {
    const Capture capture = read_capture(path);
    if (route.profile == Profile::paper && capture.dishes.size() > 1) continue;
    std::vector<std::array<int, 2>> pairs = capture.pairs;
    if (pairs.empty()) pairs.push_back({0, 1});
    for (const std::array<int, 2>& pair : pairs) {
      CaptureSession session(capture, pair, choose_dishes(capture, ""), parameters, route.labels);
      append_rows(path.filename().string(), pair, session.measure(kSeed), rows);
    }
  }
  return rows;
}

}  // namespace traygauge::golden
