#include <ostream>

#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/card/measured_card.hpp"
#include "firmware/config/station_writing.hpp"
#include "firmware/setup/setup_steps.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

std::string describe_card(const CardDescription& card) {
  return fixed(card.width_mm, 2) + " x " + fixed(card.height_mm, 2) + " mm, " + fixed(card.thickness_mm, 2) +
         " mm thick, looks like " + printable(card.pattern.path.string());
}

// Paper for the printer, and the picture by which the card is found.
bool make_sheet(SetupSite& site) {
  std::string paper;
  site.dialogue.ask_until("Paper of the printer: a4 or letter", "a4",
                          [&paper](const std::string& answer) -> std::string {
                            paper = answer;
                            return answer == "a4" || answer == "letter" ? "" : "Type a4 or letter.";
                          });
  const std::string folder = site.beside("").string();
  return site.tools.run_program("traygauge-card", {"card", "--paper", paper, "--out",
                                                   folder.empty() ? "." : folder}) == kExitMeasured;
}

}  // namespace

bool set_up_card(SetupSite& site) {
  if (const StationFile station = site.read(); station.card) {
    site.dialogue.say("The card: " + describe_card(*station.card) + ".");
    if (site.dialogue.confirm("Is that the card that lies on the trays?", true)) return true;
  }
  while (!std::filesystem::exists(site.beside("card.png"))) {
    if (!make_sheet(site) && !site.dialogue.try_again()) return false;
  }
  site.dialogue.say(
      "The card is printed from card.pdf at 100 %, both sides glued onto plastic of credit-card size, "
      "without a film. " +
      printable(site.beside("card.png").string()) + " is what it looks like.");
  bool is_written = false;
  site.dialogue.ask_until(
      "Its size by a caliper, in mm, as WIDTHxHEIGHTxTHICKNESS such as 85.4x53.9x1.0; Enter: later", {},
      [&](const std::string& answer) -> std::string {
        if (answer.empty()) return {};
        try {
          const MeasuredCard card = read_measured_card(answer);
          if (!card.thickness_mm)
            return "The thickness is missing: a quarter of a millimetre is 1 % of a volume.";
          site.dialogue.out() << describe_print(card);
          write_station_table(site.file, "card", compose_card_table(card));
          is_written = true;
          return {};
        } catch (const UsageError& error) {
          return error.what();
        }
      });
  return is_written;
}

}  // namespace traygauge
