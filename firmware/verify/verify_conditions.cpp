#include "firmware/verify/verify_conditions.hpp"

#include "firmware/base/build_info.hpp"
#include "firmware/base/text.hpp"
#include "firmware/base/toml_text.hpp"
#include "firmware/base/wall_clock.hpp"
#include "firmware/config/dish_file.hpp"
#include "firmware/config/station_file.hpp"
#include "firmware/verify/verify_command.hpp"
#include "simulator/capture/content_hash.hpp"
#include "simulator/capture/input_bytes.hpp"
#include "simulator/capture/picture_file.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxDigestedBytes = std::size_t{1} << 20U;

std::string or_not_stated(const std::string& text) {
  return text.empty() ? "not stated" : text;
}

// Wherever its values stand, and whatever else stands there.
std::string digest_of_lens(const CameraDescription& camera) {
  std::string text;
  for (const double value : {camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px})
    text += toml_number(value) + " ";
  for (const double value : camera.coefficients()) text += toml_number(value) + " ";
  return content_hash(text);
}

}  // namespace

VerifyHeader begin_verify_header(const VerifyRunOptions& options, const VerifyPlan& plan) {
  VerifyHeader header;
  const std::string commit = built_commit();
  header.program = program_version() + (commit.empty() ? std::string() : " (" + commit + ")");
  header.started = utc_text(read_wall_clock().unix_ms);
  header.plan = plan;
  header.conditions = {{"tester", or_not_stated(options.tester)},
                       {"temperature", or_not_stated(options.temperature)},
                       {"dish", plan.dish}};
  return header;
}

std::string describe_camera(const CameraDescription& camera) {
  return std::to_string(camera.size.width) + " × " + std::to_string(camera.size.height) + ", focal length " +
         fixed(camera.fx_px, 1) + " px, lens " + digest_of_lens(camera);
}

std::string describe_card(const CardDescription& card) {
  return fixed(card.width_mm, 2) + " × " + fixed(card.height_mm, 2) + " × " + fixed(card.thickness_mm, 2) +
         " mm, print " + content_hash(load_pattern(card).pixels);
}

void add_station_conditions(const StationFile& station, const DishDescription& dish, VerifyHeader& header) {
  const LensConfig& lens = *station.lens;
  header.conditions.push_back({"pictures", "a station's devices"});
  header.conditions.push_back({"station file", station.file.filename().string()});
  header.conditions.push_back({"camera", station.camera.device + ", " + describe_camera(lens.camera)});
  header.conditions.push_back({"lens", "calibrated on " + or_not_stated(lens.calibrated_on)});
  header.conditions.push_back({"second view", station.arm             ? "by an arm"
                                              : station.second_camera ? "by a second camera"
                                                                      : "by hand"});
  header.conditions.push_back({"outlines", station.labels ? "given" : "found"});
  header.conditions.push_back({"card", describe_card(*station.card)});
  header.conditions.push_back({"description of the dish", content_hash(compose_dish_file(dish))});
  const auto bytes = read_bytes({station.file, ""}, kMaxDigestedBytes, "a station file");
  header.conditions.push_back({"configuration", content_hash(bytes)});
}

}  // namespace traygauge
