#include <algorithm>
#include <sstream>
#include <system_error>

#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/base/toml_text.hpp"
#include "firmware/config/config_folder.hpp"
#include "firmware/config/dish_choice.hpp"
#include "firmware/config/station_writing.hpp"
#include "firmware/enrol/enrol_command.hpp"
#include "firmware/record/capture_recording.hpp"
#include "firmware/setup/setup_steps.hpp"
#include "simulator/capture/output_file.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

// As soon as the site has dishes of its own, it has all of them beside its file.
void own_dishes(const SetupSite& site) {
  const fs::path folder = site.beside("dishes");
  if (fs::exists(folder)) return;
  std::error_code error;
  fs::copy(find_config_folder({}) / "dishes", folder, fs::copy_options::recursive, error);
  if (error) throw OutputError(folder, error.message());
}

bool record_empty_dish(SetupSite& site, const fs::path& folder) {
  const StationFile station = site.read();
  const std::unique_ptr<SetupDevices> opened = site.tools.open_devices(station);
  site.dialogue.say(
      "Draw a fine pattern on the dish's inner side with a washable pen, unless it has one: plain glaze "
      "shows nothing to be measured. Lay it empty beside the card, and press the button.");
  return record_captures(station, opened->devices(), {folder, 1, kSetupRetries}, site.stop,
                         site.dialogue.out(), site.dialogue.out());
}

bool learn_dish(SetupSite& site) {
  EnrolOptions options;
  return try_until_done(site, [&] {
    require_geometry(site.read());
    options.style = site.dialogue.ask("What is it called? Letters, digits, - and _", options.style);
    options.size = site.dialogue.ask(
        "Its size by a ruler, in mm, as LENGTHxWIDTHxRIM such as 262x262x23; RIM is the height of its rim "
        "over the table",
        options.size);
    const PassingFolder folder;
    if (!record_empty_dish(site, folder.path())) return false;
    own_dishes(site);
    options.capture = fs::directory_iterator(folder.path())->path().string();
    options.out = site.beside("dishes").string();
    return run_enrol(options, site.dialogue.out()) == kExitMeasured;
  });
}

std::string list_dishes(const std::vector<DishDescription>& dishes) {
  std::string text = "Dishes that are known:";
  for (const DishDescription& dish : dishes) {
    text.append("\n  ").append(printable(dish.style)).append("  ");
    text.append(fixed(dish.outer_size_mm[0], 0)).append(" x ").append(fixed(dish.outer_size_mm[1], 0));
    text.append(" mm, rim ").append(fixed(dish.rim_height_mm, 0)).append(" mm");
  }
  return text;
}

std::vector<std::string> words_of(const std::string& answer) {
  std::istringstream stream(answer);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::string as_toml(const std::vector<std::string>& styles) {
  std::string text;
  for (const std::string& style : styles) text.append(text.empty() ? "" : ", ").append(toml_text(style));
  return "[" + text + "]";
}

}  // namespace

bool set_up_dishes(SetupSite& site) {
  while (true) {
    const std::vector<DishDescription> known = read_station_dishes(site.file);
    site.dialogue.say(list_dishes(known));
    const std::vector<std::string> chosen = site.read().dishes;
    std::string usual = "any";
    if (!chosen.empty()) usual.clear();
    for (const std::string& style : chosen) usual.append(usual.empty() ? "" : " ").append(style);
    const std::string answer = site.dialogue.ask(
        "Which of them stand on every tray? Names with blanks between; any: one of them, whichever; new: "
        "learn another",
        usual);
    if (answer == "new") {
      if (!learn_dish(site)) return false;
      continue;
    }
    if (answer == usual) return true;
    if (answer == "any") {
      remove_station_value(site.file, "trays", "dishes");
      return true;
    }
    const std::vector<std::string> styles = words_of(answer);
    const auto found = find_dishes(styles, known);
    if (found.ok()) {
      write_station_value(site.file, "trays", "dishes", as_toml(styles));
      return true;
    }
    site.dialogue.say("There is no dish " + printable(found.failure()) + ".");
  }
}

}  // namespace traygauge
