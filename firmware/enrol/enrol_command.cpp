#include "firmware/enrol/enrol_command.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <ostream>
#include <system_error>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/program.hpp"
#include "firmware/config/config_folder.hpp"
#include "firmware/config/dish_file.hpp"
#include "firmware/enrol/empty_dish.hpp"
#include "firmware/enrol/enrol_report.hpp"
#include "firmware/measure/measure_choices.hpp"
#include "simulator/capture/png_writer.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxStyleLength = 64;

// The style is the file's name, too.
void check_style(const std::string& style) {
  const bool is_name = std::all_of(style.begin(), style.end(), [](unsigned char c) {
    return c < 0x80 && (std::isalnum(c) != 0 || c == '-' || c == '_');
  });
  if (!style.empty() && style.size() <= kMaxStyleLength && is_name) return;
  throw UsageError("--style: expected a name of letters, digits, - and _, found " + printable(style));
}

std::filesystem::path file_of(const EnrolOptions& options) {
  const std::filesystem::path folder = options.out.empty() ? find_config_folder(options.config) / "dishes"
                                                           : std::filesystem::path(options.out);
  std::filesystem::path file = folder / (options.style + ".toml");
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) throw OutputError(file, "its folder does not exist");
  if (std::filesystem::exists(file, ignored) && !options.force) {
    throw UsageError(
        "--style " + options.style + ": " + printable(file.string()) +
        " describes a dish of this name already; choose another name, or add --force to replace it");
  }
  return file;
}

void require_outlines(const Capture& capture, const std::array<int, 2>& pair) {
  for (const int i : pair) {
    if (capture.views[static_cast<std::size_t>(i)].labels) continue;
    throw InputError({capture.file, "views[" + std::to_string(i) + "].labels"}, "a label picture", "nothing",
                     "outline dish and card, or add --size LENGTHxWIDTHxRIM, by a ruler, and they are found");
  }
}

}  // namespace

void add_enrol_command(Program& program, EnrolOptions& options) {
  Command command =
      program.add_command("enrol-dish", "Learn a dish's size and inner surface from pictures of it empty");
  command.add_option("capture", options.capture, "Folder with capture.json: the empty dish and the card")
      .required();
  command.add_option("--style", options.style, "The dish's name").required();
  command.add_option("--out", options.out,
                     "Folder for NAME.toml; default: dishes/ in the folder of --config");
  command.add_option("--size", options.size,
                     "LENGTHxWIDTHxRIM by a ruler, in mm, such as 262x262x23: find the outlines, where the "
                     "capture has no label pictures or others shall be found");
  command.add_option("--pair", options.pair, "The two views A,B; default: the first of the capture's pairs");
  command.add_option("--seed", options.seed, "Seed of all randomness, default 0");
  command.add_option("--config", options.config, "Folder with dishes/").environment("TRAYGAUGE_CONFIG");
  command.add_flag("--force", options.force, "Replace a dish of the same name");
  command.add_flag("--json", options.json, "Print one JSON document instead of a table");
}

int run_enrol(const EnrolOptions& options, std::ostream& out) {
  check_style(options.style);
  EnrolReport report;
  report.seed = parse_seed(options.seed);
  const std::filesystem::path file = file_of(options);
  const Capture capture = read_capture(options.capture);
  report.capture = options.capture;
  report.pair = choose_pair(options.pair, capture);
  std::optional<RuledDish> ruled;
  if (!options.size.empty()) ruled = read_ruled_dish(options.size);
  if (!ruled) require_outlines(capture, report.pair);
  EmptyDish dish(capture, report.pair, ruled);
  const DishSurvey& survey = dish.survey(report.seed);
  report.survey = &survey;
  if (survey.status.ok()) {
    report.dish = describe_dish(survey.fitted.dish, options.style);
    report.file = file.string();
    write_dish_file(file, report.dish);
  }
  out << (options.json ? compose_enrol_document(report) + "\n" : compose_enrol_table(report));
  return survey.status.ok() ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace traygauge
