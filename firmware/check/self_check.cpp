#include "firmware/check/self_check.hpp"

#include <pwd.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <sstream>
#include <system_error>
#include <vector>

#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/check/device_check.hpp"
#include "firmware/command/program.hpp"
#include "firmware/command/sibling_program.hpp"
#include "firmware/config/dish_choice.hpp"
#include "firmware/config/station_file.hpp"
#include "firmware/handover/kept_results.hpp"
#include "firmware/journal/format_check.hpp"
#include "firmware/station/site_scene.hpp"
#include "firmware/support/bounded_program.hpp"
#include "simulator/capture/input_error.hpp"
#include "simulator/capture/truth.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// A board under emulation takes 40 s; a processor that takes longer is of no use to a station either.
constexpr std::chrono::seconds kMeasuresWithin{120};
constexpr std::chrono::seconds kHubChecksWithin{20};
// What the README promises of every item.
constexpr double kMaxError = 0.1;

fs::path find_capture() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const char* const place :
       {"../simulator/demo/mash_and_meatballs", "../../../share/traygauge/self-check"}) {
    fs::path folder = (program / place).lexically_normal();
    if (fs::is_regular_file(folder / "capture.json", ignored)) return folder;
  }
  throw InputError({program, ""}, "the capture that comes with the program", "none",
                   "install the program anew, or pass --capture");
}

// A service does not run as root, and may be refused what root reads.
std::vector<std::string> as_user(const char* user, std::vector<std::string> command) {
  if (::geteuid() != 0 || ::getpwnam(user) == nullptr) return command;
  std::vector<std::string> prefixed = {"setpriv",           std::string("--reuid=") + user,
                                       "--regid=traygauge", "--init-groups",
                                       "--no-new-privs",    "--"};
  prefixed.insert(prefixed.end(), command.begin(), command.end());
  return prefixed;
}

std::string in_one_line(const std::string& text) {
  std::string line;
  std::istringstream lines(text);
  for (std::string part; std::getline(lines, part);) line += (line.empty() ? "" : " ") + part;
  return line.empty() ? "it said nothing" : line;
}

// The last line that is a scan's document.
std::optional<Json> find_document(const std::string& output) {
  std::optional<Json> found;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    Json json = Json::parse(line, nullptr, false);
    if (json.is_object() && json.contains("items") && json["items"].is_array()) found = std::move(json);
  }
  return found;
}

std::optional<double> volume_of(const Json& document, int label) {
  for (const Json& item : document["items"]) {
    if (item.value("label", 0) == label && item.contains("volume_ml") && item["volume_ml"].is_number())
      return item["volume_ml"].get<double>();
  }
  return std::nullopt;
}

CheckResult check_measurement(const fs::path& capture) {
  CheckResult result{"measurement", false, {}};
  const std::optional<Truth> truth = read_truth(capture);
  if (!truth || truth->items.empty()) {
    result.text = capture.string() + " has no truth.json to compare with";
    return result;
  }
  const std::string output =
      output_of(as_user("traygauge-station", {sibling_path("traygauge-station"), "station", "--devices",
                                              "simulator:" + capture.string(), "--scans", "1", "--json"}),
                kMeasuresWithin);
  const std::optional<Json> document = find_document(output);
  if (!document) {
    result.text = "the station measured nothing; it said: " + in_one_line(output);
    return result;
  }
  result.is_good = true;
  for (const TruthItem& item : truth->items) {
    const std::optional<double> volume = volume_of(*document, item.label);
    if (!result.text.empty()) result.text += ", ";
    result.text +=
        item.name + " " + (volume ? fixed(*volume, 1) : "not") + " of " + fixed(item.volume_ml, 1) + " ml";
    result.is_good =
        result.is_good && volume && std::abs(*volume - item.volume_ml) <= kMaxError * item.volume_ml;
  }
  return result;
}

CheckResult check_journal(const HandoverConfig& handover) {
  CheckResult result{"journal", true, "what waits in " + handover.folder.string() + " can be read"};
  for (const Expected<void>& checked : {check_journal_format(KeptResults::journal_file(handover.folder)),
                                        check_counter_format(KeptResults::counter_file(handover.folder))}) {
    if (!checked.ok()) return {result.device, false, checked.failure()};
  }
  return result;
}

CheckResult check_hub(const std::string& station) {
  const std::string output = output_of(
      as_user("traygauge-hub", {sibling_path("traygauge-hub"), "hub", "--config", station, "--check"}),
      kHubChecksWithin);
  return {"hub", output.find(": as expected for a hub") != std::string::npos, in_one_line(output)};
}

class SelfCheck {
 public:
  explicit SelfCheck(std::ostream& out) : out_(out) {}

  void tell(const CheckResult& result) {
    out_ << (result.is_good ? "ok    " : "FAIL  ") << result.device << ": " << printable(result.text)
         << std::endl;
    all_good_ = all_good_ && result.is_good;
  }
  // What station and hub find where they last stopped.
  void check_site(const std::string& file) {
    CheckResult result{"configuration", true, file + " is as expected"};
    std::optional<StationFile> station;
    try {
      station = read_station_file(file);
      const SiteScene scene(*station, read_station_dishes(station->file));
    } catch (const InputError& error) {
      result = {result.device, false, error.what()};
    }
    tell(result);
    if (!station) return;
    if (station->has_hub) tell(check_hub(file));
    if (station->handover) tell(check_journal(*station->handover));
  }
  bool all_good() const { return all_good_; }

 private:
  std::ostream& out_;
  bool all_good_ = true;
};

}  // namespace

void add_self_check_command(Program& program, SelfCheckOptions& options) {
  Command command = program.add_command(
      "self-check", "Say whether these programs can take over from others; tries no device");
  command.add_option("STATION", options.station, "The station file; see config/station.toml").required();
  command.add_option("--capture", options.capture,
                     "A capture with truth.json, measured instead of the one that came with the program");
}

int run_self_check(const SelfCheckOptions& options, std::ostream& out) {
  SelfCheck check(out);
  check.tell(check_measurement(options.capture.empty() ? find_capture() : fs::path(options.capture)));
  check.check_site(options.station);
  return check.all_good() ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace traygauge
