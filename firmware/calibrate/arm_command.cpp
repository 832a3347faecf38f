#include <ostream>

#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/calibrate/arm_calibration.hpp"
#include "firmware/calibrate/calibrate_command.hpp"
#include "firmware/card/card_finder.hpp"
#include "firmware/config/station_writing.hpp"
#include "firmware/measure/measure_choices.hpp"
#include "firmware/measure/pair_setup.hpp"

namespace traygauge {
namespace {

// The card in both views of the capture's pair; false, having said so, where it is not seen.
bool see_move(const std::string& folder, SeenMove& move, std::ostream& out) {
  const Capture capture = read_capture(folder);
  const auto pair = choose_pair("", capture);
  const Picture pattern = load_pattern(capture.card);
  std::array<Pose, 2> cameras;
  std::array<double, 2> angles_deg{};
  for (std::size_t i = 0; i < 2; ++i) {
    const ViewDescription& view = capture.views[static_cast<std::size_t>(pair[i])];
    if (!view.arm_angle_deg) {
      throw InputError({capture.file, "views[" + std::to_string(pair[i]) + "].arm_angle_deg"},
                       "where the arm stood", "nothing", "record the capture with the arm");
    }
    angles_deg[i] = *view.arm_angle_deg;
    CardFinder finder(view.camera.size.width, view.camera.size.height);
    CardAlignment card;
    Status status = finder.learn(card_of(capture.card, pattern));
    if (status.ok()) status = finder.find(load_view(view).picture.frame(), lens_of(view.camera), card);
    if (!status.ok()) {
      out << printable(folder) << ": no card in view " << pair[i] << "; it is left out" << std::endl;
      return false;
    }
    cameras[i] = card.camera_from_table;
  }
  move = {folder, angles_deg[1] - angles_deg[0], second_from_first(cameras)};
  const ScrewMotion motion = screw_of(move.second_from_first);
  out << printable(folder) << ": turned " << fixed(motion.angle_deg, 2) << " degrees where "
      << fixed(std::abs(move.commanded_deg), 2) << " were commanded" << std::endl;
  return true;
}

std::string place(const Vec3& v, int decimals) {
  std::string text = "(";
  text.append(fixed(v.x(), decimals)).append(", ").append(fixed(v.y(), decimals));
  return text.append(", ").append(fixed(v.z(), decimals)).append(")");
}

}  // namespace

int run_calibrate_arm(const CalibrateOptions& options, std::ostream& out) {
  const StationFile station = read_station_file(options.station);
  if (!station.arm) throw UsageError(printable(options.station) + " has no [arm] to be calibrated");
  const ArmCalibrationParams params;
  std::vector<SeenMove> moves;
  for (const std::string& folder : options.inputs) {
    SeenMove move;
    if (see_move(folder, move, out)) moves.push_back(move);
  }
  if (moves.size() < static_cast<std::size_t>(params.min_captures)) {
    throw InputError(
        {options.inputs.front(), ""},
        "at least " + std::to_string(params.min_captures) + " captures with the card in both views",
        std::to_string(moves.size()),
        "lay the card flat where both views see all of it, and record more captures");
  }
  ArmCalibration arm;
  const bool repeats = calibrate_arm(moves, params, arm);
  const double commanded_deg = std::abs(arm.geometry.commanded_deg);
  const std::string summary = std::to_string(moves.size()) + " moves of " + fixed(commanded_deg, 2) +
                              " degrees turned the camera by " + fixed(arm.motion.angle_deg, 2) + " about " +
                              place(arm.motion.axis, 3) + " through " + place(arm.motion.axis_point_mm, 0) +
                              " mm, " + fixed(arm.motion.along_axis_mm, 1) +
                              " mm along it;\nthey differ by up to " + fixed(arm.angle_spread_deg, 2) +
                              " degrees and " + fixed(arm.shift_spread_mm, 1) + " mm";
  const std::string table = compose_arm_geometry_table(arm.geometry, summary);
  out << summary << "\n\n" << table << "\n";
  if (!repeats) {
    out << "The moves differ by more than " << fixed(params.max_angle_spread_deg, 1) << " degrees or "
        << fixed(params.max_shift_spread_mm, 0)
        << " mm: the arm does not repeat, or the card or the camera moved meanwhile; tighten them and record "
           "anew.\n";
  }
  const auto* stepper = std::get_if<StepperConfig>(&station.arm->kind);
  if (repeats && stepper != nullptr && commanded_deg > 0.0) {
    out << "arm.steps_per_deg = "
        << fixed(stepper->motion.steps_per_deg * commanded_deg / arm.motion.angle_deg, 4)
        << " would make the arm turn as commanded; calibrate it again then." << std::endl;
  }
  if (!options.dry_run && (repeats || options.force)) {
    write_station_table(options.station, "arm_geometry", table);
    out << "Written to " << printable(options.station) << std::endl;
  }
  return repeats ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace traygauge
