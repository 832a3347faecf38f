#include "firmware/check/config_check.hpp"

#include <ostream>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/program.hpp"
#include "firmware/command/sibling_program.hpp"
#include "firmware/config/dish_choice.hpp"
#include "firmware/config/station_file.hpp"
#include "firmware/station/site_scene.hpp"

namespace traygauge {

void add_config_command(Program& program, ConfigCheckOptions& options) {
  Command config = program.add_command("config", "The configuration of station and hub");
  config.add_command("check", "Say what is wrong in a station file; tries no device")
      .add_option("STATION", options.station, "The station file; see config/station.toml")
      .required();
}

int run_config_check(const ConfigCheckOptions& options, std::ostream& out) {
  const StationFile station = read_station_file(options.station);
  const SiteScene scene(station, read_station_dishes(station.file));
  out << options.station << ": as expected for a station";
  if (station.handover) out << " called " << station.handover->name;
  out << "; dishes:";
  for (const std::string& style : scene.dish_styles()) out << " " << style;
  out << "." << std::endl;
  return station.has_hub
             ? run_sibling_program("traygauge-hub", {"hub", "--config", options.station, "--check"})
             : kExitMeasured;
}

}  // namespace traygauge
