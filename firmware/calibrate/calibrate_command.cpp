#include "firmware/calibrate/calibrate_command.hpp"

#include "firmware/command/program.hpp"

namespace traygauge {
namespace {

void add_common_options(Command& command, CalibrateOptions& options) {
  command.add_option("STATION", options.station, "The station file that is written; see config/station.toml")
      .required();
  command.add_flag("--dry-run", options.dry_run, "Say what comes out and write nothing");
  command.add_flag("--force", options.force, "Write it although it is not good enough");
}

}  // namespace

void add_calibrate_commands(Program& program, CalibrateOptions& options) {
  Command lens = program.add_command("lens", "The lens, from 15 to 20 pictures of a chessboard");
  add_common_options(lens, options);
  lens.add_option(
          "PICTURES", options.inputs,
          "JPEG or PNG of the camera's size, or folders of them; traygauge record --pictures takes them")
      .required();
  lens.add_option("--board", options.board,
                  "COLUMNSxROWS: the board's inner corners, one less than its fields each way, such as 9x6")
      .required();
  lens.add_flag("--second", options.second, "The lens of [second_camera]");
  Command arm = program.add_command("arm", "The arm's move between the views, from captures of the card");
  add_common_options(arm, options);
  arm.add_option("CAPTURES", options.inputs, "Captures with the card in view, as traygauge record saves them")
      .required();
}

}  // namespace traygauge
