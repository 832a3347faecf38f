#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/record/picture_recorder.hpp"
#include "firmware/setup/setup_steps.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

std::string describe_lens(const LensConfig& lens) {
  std::string text =
      lens.calibrated_on.empty() ? "described" : "calibrated on " + printable(lens.calibrated_on);
  if (lens.grade_percent)
    text += ", volumes right to " + fixed(*lens.grade_percent, 2) + " % as far as it goes";
  return text;
}

bool take_board_pictures(SetupSite& site, bool second, const PictureRecording& recording) {
  const std::unique_ptr<SetupDevices> opened = site.tools.open_devices(site.read());
  const StationDevices devices = opened->devices();
  Camera& camera = second ? *devices.second_camera : devices.camera;
  site.dialogue.say(
      "Press the button for each of " + std::to_string(recording.count) +
      " pictures. Hold the board still: near and far, tilted each way, and into all corners of the picture.");
  return record_pictures(camera, devices.trigger, devices.lamp, recording, site.stop, site.dialogue.out(),
                         site.dialogue.out());
}

bool calibrate_by_board(SetupSite& site, bool second) {
  site.dialogue.say(
      "A chessboard is needed, printed and glued onto something flat, about as large as a dish. Its inner "
      "corners are those where four fields meet: 9x6 of a board of 10 x 7 fields.");
  const PassingFolder folder;
  std::string board = "9x6";
  std::uint64_t count = site.tools.board_pictures;
  return try_until_done(site, [&] {
    board = site.dialogue.ask("How many inner corners has it?", board);
    if (!take_board_pictures(site, second, {folder.path(), count})) return false;
    std::vector<std::string> arguments = {"lens", site.file.string(), folder.path().string(), "--board",
                                          board};
    if (second) arguments.emplace_back("--second");
    count = site.tools.more_pictures;  // beside those that are there
    return site.tools.run_program("traygauge-calibrate", arguments) == kExitMeasured;
  });
}

bool set_up_one(SetupSite& site, const std::optional<LensConfig>& lens, bool second) {
  if (lens) {
    site.dialogue.say(std::string(second ? "The second lens" : "The lens") + ": " + describe_lens(*lens) +
                      ".");
    if (site.dialogue.confirm("Has nobody turned or changed it since?", true)) return true;
  }
  return calibrate_by_board(site, second);
}

}  // namespace

bool set_up_lens(SetupSite& site) {
  const StationFile station = site.read();
  if (!set_up_one(site, station.lens, false)) return false;
  return !station.second_camera || set_up_one(site, station.second_lens, true);
}

}  // namespace traygauge
