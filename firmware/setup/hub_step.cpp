#include "firmware/base/scan_id.hpp"
#include "firmware/base/toml_text.hpp"
#include "firmware/config/station_writing.hpp"
#include "firmware/setup/setup_steps.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

// Those of the units in config/systemd.
constexpr const char* kInstalledFolder = "/var/lib/traygauge";
constexpr const char* kInstalledSocket = "/run/traygauge/hub";

struct KeptResults {
  fs::path socket;
  fs::path waiting;
  fs::path store;
};

KeptResults paths_below(const fs::path& folder) {
  if (folder == kInstalledFolder)
    return {kInstalledSocket, folder / "station", folder / "hub" / "results.db"};
  return {folder / "hub", folder / "waiting", folder / "results.db"};
}

std::string path_value(const char* key, const fs::path& path) {
  return std::string(key) + " = " + toml_text(path.string()) + "\n";
}

}  // namespace

bool set_up_hub(SetupSite& site) {
  if (const StationFile station = site.read(); station.handover && station.has_hub) {
    site.dialogue.say("The station is called " + station.handover->name + "; results go to the hub at " +
                      printable(station.handover->socket.string()) + ".");
    if (site.dialogue.confirm("Is that right?", true)) return true;
  } else if (!site.dialogue.confirm("Shall a hub on this machine keep the results and show them on a page?",
                                    true)) {
    site.dialogue.say("Results are printed alone.");
    return true;
  }
  std::string name;
  site.dialogue.ask_until("What is the station called? It is unlike every other one's", "kitchen-1",
                          [&name](const std::string& answer) -> std::string {
                            name = answer;
                            return is_station_name(answer)
                                       ? ""
                                       : "Expected 1 to 32 of a-z, 0-9 and '-', with no '-' at either end.";
                          });
  const KeptResults kept = paths_below(site.dialogue.ask("Where are results kept?", kInstalledFolder));
  write_station_table(site.file, "station",
                      "[station]\nname = " + toml_text(name) + "\n" + path_value("socket", kept.socket) +
                          path_value("folder", kept.waiting));
  write_station_table(site.file, "hub",
                      "[hub]\n" + path_value("store", kept.store) + "listen = [\"127.0.0.1:8080\"]\n");
  site.dialogue.say(
      "The hub's page will be at http://127.0.0.1:8080. For other machines it needs tokens, which `[hub]` "
      "in " +
      printable(site.file.string()) + " names.");
  return true;
}

}  // namespace traygauge
