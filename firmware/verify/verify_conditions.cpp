#include "firmware/verify/verify_conditions.hpp"

#include "firmware/base/text.hpp"
#include "firmware/base/wall_clock.hpp"
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

}  // namespace

VerifyHeader begin_verify_header(const VerifyRunOptions& options, const VerifyPlan& plan) {
  VerifyHeader header;
  header.program = TRAYGAUGE_VERSION;
  header.started = utc_text(read_wall_clock().unix_ms);
  header.plan = plan;
  header.conditions = {{"tester", or_not_stated(options.tester)},
                       {"temperature", or_not_stated(options.temperature)},
                       {"dish", plan.dish}};
  return header;
}

std::string describe_camera(const CameraDescription& camera) {
  return std::to_string(camera.size.width) + " × " + std::to_string(camera.size.height) + ", focal length " +
         fixed(camera.fx_px, 1) + " px";
}

std::string describe_card(const CardDescription& card) {
  return fixed(card.width_mm, 2) + " × " + fixed(card.height_mm, 2) + " × " + fixed(card.thickness_mm, 2) +
         " mm, print " + content_hash(load_pattern(card).pixels);
}

void add_station_conditions(const StationFile& station, VerifyHeader& header) {
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
  const auto bytes = read_bytes({station.file, ""}, kMaxDigestedBytes, "a station file");
  header.conditions.push_back({"configuration", content_hash(bytes)});
}

}  // namespace traygauge
