// What `traygauge card` writes, and what it refuses.
#include "firmware/card_sheet/card_command.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <sstream>
#include <string>
#include <vector>

#include "firmware/card/card_drawing.hpp"
#include "firmware/card/known_cards.hpp"
#include "firmware/command/program.hpp"
#include "simulator/capture/picture_file.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

struct CardRun {
  int status = 0;
  std::string out;
  std::string error;
};

CardRun run_card_program(const std::vector<std::string>& arguments) {
  std::vector<const char*> pointers = {"traygauge-card", "card"};
  for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
  Program program("Makes the reference card.", "traygauge");
  CardOptions options;
  add_card_command(program, options);
  std::ostringstream out;
  std::ostringstream error;
  const int status = program.run(
      static_cast<int>(pointers.size()), pointers.data(), [&] { return run_card(options, out); }, out, error);
  return {status, out.str(), error.str()};
}

TEST(CardCommand, WritesSheetAndPicture) {
  const TemporaryFolder folder;
  const fs::path made = folder.path() / "a" / "b";
  const CardRun run = run_card_program({"--pattern", "7", "--out", made.string()});
  EXPECT_EQ(run.status, 0) << run.error;
  EXPECT_NE(run.out.find("Card TG-07"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("--measured"), std::string::npos) << run.out;
  EXPECT_EQ(read_text(made / "card.pdf").substr(0, 5), "%PDF-");
  EXPECT_EQ(read_picture({made / "card.png", ""}).pixels, card_picture(7).pixels);
  // The same again is no mistake.
  EXPECT_EQ(run_card_program({"--pattern", "7", "--out", made.string(), "--paper", "letter"}).status, 0);
}

TEST(CardCommand, AnotherCardsPictureStays) {
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  ASSERT_EQ(run_card_program({"--out", out}).status, 0);
  fs::remove(folder.path() / "card.pdf");
  const CardRun run = run_card_program({"--pattern", "2", "--out", out});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.error.find("shows another card"), std::string::npos) << run.error;
  EXPECT_EQ(number_of_card(read_picture({folder.path() / "card.png", ""}).gray()), 1);
  EXPECT_FALSE(fs::exists(folder.path() / "card.pdf"));
  write_text(folder.path() / "card.png", "no picture");
  EXPECT_EQ(run_card_program({"--out", out}).status, 2);
  EXPECT_EQ(read_text(folder.path() / "card.png"), "no picture");
}

TEST(CardCommand, SaysTheLinesOfAMeasuredCard) {
  const CardRun run = run_card_program({"--measured", "85.2x53.7x1.02"});
  EXPECT_EQ(run.status, 0) << run.error;
  EXPECT_NE(run.out.find("width_mm = 85.20\nheight_mm = 53.70\nthickness_mm = 1.02\n"), std::string::npos)
      << run.out;
}

TEST(CardCommand, TellsWhatIsWrong) {
  const TemporaryFolder folder;
  write_text(folder.path() / "file", "");
  const std::string file = (folder.path() / "file").string();
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
      {{"--pattern", "0"}, "--pattern"},
      {{"--pattern", "13"}, "1 to 12"},
      {{"--pattern", "one"}, "--pattern"},
      {{"--paper", "a3"}, "expected a4 or letter, found a3"},
      {{"--out", file}, "cannot be made"},
      {{"--out", file + "/below"}, "cannot be made"},
      {{"--measured", "83.0x52.4"}, "97 %: printed with 'fit to page'"},
      {{"--measured", "85.6x53.98", "--pattern", "2"}, "excludes"},
      {{"--measured", "85.6x53.98", "--out", "."}, "excludes"},
      {{"more"}, "more"},
      {{"--unknown"}, "--unknown"},
  };
  for (const auto& [arguments, named] : mistakes) {
    const CardRun run = run_card_program(arguments);
    EXPECT_EQ(run.status, 2) << named;
    EXPECT_EQ(run.out, "") << named;
    EXPECT_EQ(run.error.find("traygauge: "), 0U) << run.error;
    EXPECT_EQ(std::count(run.error.begin(), run.error.end(), '\n'), 1) << run.error;
    EXPECT_NE(run.error.find(named), std::string::npos) << named << ": " << run.error;
  }
}

TEST(CardCommand, FolderThatTakesNothingIsTold) {
  const TemporaryFolder folder;
  // A folder of that name is in the way of the sheet, for root, too.
  fs::create_directory(folder.path() / "card.pdf");
  const CardRun run = run_card_program({"--out", folder.path().string()});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.error.find("card.pdf: cannot be written"), std::string::npos) << run.error;
  EXPECT_FALSE(fs::exists(folder.path() / "card.png"));
  if (geteuid() == 0) return;  // may write everywhere
  const fs::path closed = folder.path() / "closed";
  fs::create_directory(closed);
  fs::permissions(closed, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(run_card_program({"--out", closed.string()}).status, 2);
}

}  // namespace
}  // namespace traygauge
