#include "firmware/card_sheet/card_command.hpp"

#include <ostream>
#include <string>
#include <system_error>

#include "firmware/base/exit_status.hpp"
#include "firmware/card/card_drawing.hpp"
#include "firmware/card/measured_card.hpp"
#include "firmware/card_sheet/card_sheet.hpp"
#include "firmware/command/program.hpp"
#include "simulator/capture/input_error.hpp"
#include "simulator/capture/picture_file.hpp"
#include "simulator/capture/png_writer.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (!fs::is_directory(folder)) {
    const std::string reason = problem ? problem.message() : "a file of that name is there";
    throw UsageError("--out: the folder " + printable(folder.string()) + " cannot be made: " + reason);
  }
}

// A station may be in use with the picture that is there.
void require_no_other_picture(const fs::path& file, const Picture& picture) {
  if (!fs::exists(file)) return;
  bool is_same = false;
  try {
    is_same = to_gray(read_picture({file, ""})).pixels == picture.pixels;
  } catch (const InputError&) {
    is_same = false;
  }
  if (is_same) return;
  throw UsageError(printable(file.string()) +
                   " is there already and shows another card; name another folder with --out, or remove it");
}

int make_card(const CardOptions& options, std::ostream& out) {
  const SheetPaper paper = choose_paper(options.paper);
  make_folder(options.out);
  const fs::path sheet = options.out / "card.pdf";
  const fs::path picture_file = options.out / "card.png";
  const Picture picture = card_picture(options.pattern);
  require_no_other_picture(picture_file, picture);
  write_card_sheet(sheet, options.pattern, paper);
  write_png(picture_file, picture.frame());
  out << "Card " << card_id(options.pattern) << ": " << printable(sheet.string())
      << " to print at 100 %, not fitted to the page; " << printable(picture_file.string())
      << " for the folder of the station file or of capture.json.\n"
      << "Then measure the finished card with a caliper: traygauge card --measured "
         "WIDTHxHEIGHTxTHICKNESS\n";
  return kExitMeasured;
}

int describe_card(const std::string& measured, std::ostream& out) {
  const MeasuredCard card = read_measured_card(measured);
  out << describe_print(card) << "\n" << compose_card_lines(card);
  return kExitMeasured;
}

}  // namespace

void add_card_command(Program& program, CardOptions& options) {
  Command command =
      program.add_command("card", "Make the reference card to print, and read what a caliper says of it");
  const CommandOption pattern = command
                                    .add_option("--pattern", options.pattern,
                                                "Which card; cards of different stations may have the same")
                                    .range(1, kCardPatterns)
                                    .show_default();
  const CommandOption paper = command.add_option("--paper", options.paper, "a4 or letter").show_default();
  const CommandOption folder =
      command.add_option("--out", options.out, "Folder for card.pdf and card.png").show_default();
  command
      .add_option("--measured", options.measured,
                  "WIDTHxHEIGHT or WIDTHxHEIGHTxTHICKNESS of the finished card in mm, such as 85.4x53.9x1.0: "
                  "print the lines for the station file and capture.json")
      .excludes(pattern)
      .excludes(paper)
      .excludes(folder);
}

int run_card(const CardOptions& options, std::ostream& out) {
  return options.measured.empty() ? make_card(options, out) : describe_card(options.measured, out);
}

}  // namespace traygauge
