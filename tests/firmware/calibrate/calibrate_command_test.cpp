// What `traygauge calibrate` reads, writes and refuses.
#include "firmware/calibrate/calibrate_command.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/calibrate/standard_meal.hpp"
#include "firmware/config/station_writing.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "simulator/capture/png_writer.hpp"
#include "tests/firmware/calibrate/board_views.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;
using namespace test;

constexpr const char* kStation =
    "# our kitchen\n[camera]\ndevice = \"serial:A1\"\nwidth = 640\nheight = 480\nfocus = 30\n\n"
    "[lens]  # old\nfx = 500\nfy = 500\ncx = 320\ncy = 240\ndistortion = [0, 0, 0, 0, 0]\n\n# the "
    "button\n[button]\nline = "
    "\"TRIGGER\"\n";

class CalibrateCommand : public ::testing::Test {
 protected:
  CalibrateCommand() {
    options_.station = (folder_.path() / "station.toml").string();
    options_.board = "9x6";
    options_.inputs = {(folder_.path() / "pictures").string()};
    fs::create_directory(options_.inputs[0]);
    write_text(options_.station, kStation);
  }
  void draw(const BoardHandling& handling) {
    const auto poses = hold_board(kBoard, lens_, handling, 1);
    for (std::size_t i = 0; i < poses.size(); ++i)
      write_png(picture(i), draw_board(kBoard, lens_, poses[i], i).frame());
  }
  fs::path picture(std::size_t number) const {
    return fs::path(options_.inputs[0]) / (std::to_string(100 + number) + ".png");
  }
  template <class Error>
  std::string refusal(int (*run)(const CalibrateOptions&, std::ostream&)) {
    try {
      run(options_, out_);
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing";
  }
  static bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  TemporaryFolder folder_;
  LensModel lens_ = phone_lens(0.4);
  CalibrateOptions options_;
  std::ostringstream out_;
};

TEST_F(CalibrateCommand, WritesTheLensOfItsPicturesAndLeavesTheRestAlone) {
  draw({14, 32.0, true});
  write_png(picture(50), Picture({640, 480}, PixelFormat::gray8).frame());
  options_.dry_run = true;
  ASSERT_EQ(run_calibrate_lens(options_, out_), kExitMeasured) << out_.str();
  EXPECT_EQ(read_text(options_.station), kStation);
  options_.dry_run = false;
  ASSERT_EQ(run_calibrate_lens(options_, out_), kExitMeasured) << out_.str();
  EXPECT_TRUE(has(out_.str(), "150.png: no board; it is left out")) << out_.str();
  EXPECT_TRUE(has(out_.str(), "grade: volumes right to ")) << out_.str();
  const StationFile station = read_station_file(options_.station);
  ASSERT_TRUE(station.lens);
  EXPECT_EQ(station.lens->focus, 30);
  EXPECT_EQ(station.lens->calibrated_camera, "serial:A1");
  EXPECT_EQ(station.lens->calibrated_on.size(), 10U);
  EXPECT_EQ(find_lens_change(*station.lens, station.camera, 30), "");
  ASSERT_TRUE(station.lens->grade_percent);
  EXPECT_TRUE(has(out_.str(), "grade: volumes right to " + fixed(*station.lens->grade_percent, 2) + " %"));
  const double percent = 100.0 * volume_deviation(lens_, lens_of(station.lens->camera), {}).value();
  EXPECT_LT(std::abs(percent), 0.5);
  const std::string text = read_text(options_.station);
  EXPECT_TRUE(text.starts_with("# our kitchen\n[camera]\n")) << text;
  EXPECT_TRUE(text.ends_with("\n\n# the button\n[button]\nline = \"TRIGGER\"\n")) << text;
  EXPECT_FALSE(has(text, "# old")) << text;
}

TEST_F(CalibrateCommand, SaysWhatIsWrongWithThePictures) {
  EXPECT_TRUE(has(refusal<InputError>(run_calibrate_lens), "at least 10 pictures that show the whole board"));
  draw({1, 0.0, true});
  EXPECT_TRUE(has(refusal<InputError>(run_calibrate_lens), "found 1; check --board"));
  write_png(picture(5), Picture({320, 240}, PixelFormat::gray8).frame());
  EXPECT_TRUE(has(refusal<InputError>(run_calibrate_lens), "105.png: expected"));
  options_.inputs = {"/nowhere/at/all.png"};
  EXPECT_TRUE(has(refusal<InputError>(run_calibrate_lens), "/nowhere/at/all.png"));
  for (const char* board : {"9", "9x", "x6", "9x6x3", "2x9", "9x999", "-9x6"}) {
    options_.board = board;
    EXPECT_TRUE(has(refusal<UsageError>(run_calibrate_lens), "--board: expected inner corners")) << board;
  }
  options_.board = "9x6";
  options_.second = true;
  EXPECT_TRUE(has(refusal<UsageError>(run_calibrate_lens), "has no [second_camera]"));
  EXPECT_EQ(read_text(options_.station), kStation);
}

class CalibrateArm : public CalibrateCommand {
 protected:
  static constexpr const char* kArm = "[arm]\nkind = \"serial\"\ndevice = \"/dev/ttyUSB0\"\n";
  CalibrateArm() {
    write_text(options_.station, std::string(kStation) + kArm);
    const fs::path capture = fs::path(TRAYGAUGE_SOURCE_DIR) / "simulator/demo/mash_and_meatballs";
    options_.inputs.assign(3, capture.string());
  }
};

TEST_F(CalibrateArm, FindsTheMoveOfARecordedCapture) {
  ASSERT_EQ(run_calibrate_arm(options_, out_), kExitMeasured) << out_.str();
  const StationFile station = read_station_file(options_.station);
  ASSERT_TRUE(station.arm_geometry);
  EXPECT_EQ(station.arm_geometry->commanded_deg, 15.2);
  EXPECT_NEAR(station.arm_geometry->angle_deg(), 15.2, 0.15);
  EXPECT_TRUE(has(out_.str(), "they differ by up to 0.00 degrees")) << out_.str();
}

TEST_F(CalibrateArm, SaysWhatIsWrongWithTheCaptures) {
  options_.inputs.resize(2);
  EXPECT_TRUE(has(refusal<InputError>(run_calibrate_arm), "at least 3 captures with the card in both views"));
  TemporaryCapture capture;
  for (auto& view : capture.document["views"]) view.erase("arm_angle_deg");
  capture.store();
  options_.inputs = {capture.folder().string()};
  EXPECT_TRUE(has(refusal<InputError>(run_calibrate_arm), "arm_angle_deg"));
  write_text(options_.station, kStation);
  EXPECT_TRUE(has(refusal<UsageError>(run_calibrate_arm), "has no [arm]"));
}

TEST(StationWriting, TablesAreReplacedWhereTheyStandOrAdded) {
  EXPECT_EQ(with_table("a = 1\n", "lens", "[lens]\nfx = 2\n"), "a = 1\n\n[lens]\nfx = 2\n");
  EXPECT_EQ(with_table("[lens]\nfx = 1\n\n# next\n[card]\n", "lens", "[lens]\nfx = 2\n"),
            "[lens]\nfx = 2\n\n# next\n[card]\n");
  EXPECT_EQ(with_table("[second_lens]\nfx = 1\n[ lens ] # here\nfx = 1", "lens", "[lens]\n"),
            "[second_lens]\nfx = 1\n[lens]\n");
  EXPECT_EQ(with_table("# [lens]\n# fx = 1\n", "lens", "[lens]\n"), "# [lens]\n# fx = 1\n\n[lens]\n");
}

}  // namespace
}  // namespace traygauge
