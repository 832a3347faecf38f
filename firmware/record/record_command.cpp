#include "firmware/record/record_command.hpp"

#include <ostream>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/program.hpp"
#include "firmware/record/capture_recording.hpp"
#include "firmware/record/picture_recorder.hpp"
#include "firmware/station/hardware.hpp"

namespace traygauge {
void add_record_command(Program& program, RecordOptions& options) {
  Command command = program.add_command("record", "Save captures: press the button for each tray");
  command.add_option("STATION", options.station, "The station file, see config/station.toml").required();
  command.add_option("--out", options.out, "Folder for the captures").required();
  command.add_flag(
      "--pictures", options.pictures,
      "Single pictures, such as of a chessboard for traygauge calibrate; neither lens nor card need "
      "be known");
  command.add_option("--count", options.count, "End after so many").positive();
}

int run_record(const RecordOptions& options, const std::atomic<bool>& stop, std::ostream& out,
               std::ostream& log) {
  const StationFile station_file = read_station_file(options.station);
  if (options.pictures) {
    Hardware hardware(station_file);
    const bool ended = record_pictures(hardware.camera(), hardware.trigger(), hardware.lamp(),
                                       {options.out, options.count}, stop, out, log);
    return ended ? kExitMeasured : kExitNotMeasurable;
  }
  require_geometry(station_file);
  Hardware hardware(station_file);
  warn_of_changed_lenses(station_file, hardware, log);
  const CaptureRecording recording{options.out, options.count};
  return record_captures(station_file, hardware.devices(), recording, stop, out, log) ? kExitMeasured
                                                                                      : kExitNotMeasurable;
}

}  // namespace traygauge
