// `traygauge setup` on simulated devices that see a tray of the demo, answered as a person would, and
// otherwise.
#include <gtest/gtest.h>

#include <cstring>
#include <deque>
#include <random>
#include <sstream>

#include "firmware/base/exit_status.hpp"
#include "firmware/config/station_writing.hpp"
#include "firmware/setup/setup_command.hpp"
#include "firmware/station/recorded_captures.hpp"
#include "simulator/devices/simulated_arm.hpp"
#include "simulator/devices/simulated_camera.hpp"
#include "simulator/devices/simulated_clock.hpp"
#include "simulator/devices/simulated_indicator.hpp"
#include "simulator/devices/simulated_trigger.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

const fs::path kDemo = TRAYGAUGE_SOURCE_DIR "/simulator/demo/mash_and_meatballs";
constexpr double kSecondViewDeg = 15.2;    // of the demo
constexpr double kTrueMl = 124.1 + 110.4;  // its truth.json

constexpr const char* kStation = R"(# My station.
[camera]
device = "/dev/video0"  # the one above the tray
[button]
line = "gpiochip0/17"
[lamp]
lines = ["gpiochip0/22"]
ready = ["gpiochip0/22"]
hold_still = ["gpiochip0/22"]
busy = ["gpiochip0/22"]
done = ["gpiochip0/22"]
try_again = ["gpiochip0/22"]
fault = ["gpiochip0/22"]
)";
constexpr const char* kArm = R"([arm]
kind = "serial"
device = "/dev/ttyACM0"
second_view_deg = 15.2
)";

class PlayedDevices final : public SetupDevices {
 public:
  PlayedDevices(MeasurableCaptures& captures, std::deque<DeviceCode>& camera_faults, bool has_arm)
      : player_(captures, has_arm ? CameraMover::arm : CameraMover::hand),
        camera_(clock_, player_, has_arm ? &arm_ : nullptr),
        has_arm_(has_arm) {
    player_.handle_press();  // somebody has put the tray there
    trigger_.before_press([this] {
      if (!has_arm_) player_.handle_press();
    });
    if (camera_faults.empty()) return;
    if (camera_faults.front() != DeviceCode::ok) camera_.faults().add({camera_faults.front(), 1, 1000});
    camera_faults.pop_front();
  }
  StationDevices devices() override { return {camera_, trigger_, has_arm_ ? &arm_ : nullptr, lamp_, clock_}; }

 private:
  SimulatedClock clock_;
  TrayPlayer player_;
  SimulatedArm arm_{clock_};
  SimulatedCamera camera_;
  SimulatedIndicator lamp_{clock_};
  SimulatedTrigger trigger_{clock_, lamp_, 100};
  bool has_arm_;
};

class Setup : public testing::Test {
 protected:
  explicit Setup(bool has_arm = true) : has_arm_(has_arm) {
    write_text(file(), std::string(kStation) + (has_arm ? kArm : ""));
    tools_.open_devices = [this](const StationFile&) {
      return std::make_unique<PlayedDevices>(*captures_, camera_faults_, has_arm_);
    };
    tools_.list_cameras = [this] { return cameras_; };
    tools_.run_program = [this](const std::string& name, const std::vector<std::string>& arguments) {
      return play_program(name, arguments);
    };
    tools_.board_pictures = 3;
    tools_.more_pictures = 2;
    fs::copy(TRAYGAUGE_SOURCE_DIR "/config/dishes", folder_.path() / "dishes");
    cameras_.cameras = {{"/dev/video0", "Laptop lid", "usb-1", ""},
                        {"/dev/video2", "HD camera", "usb-2", "A1"}};
  }

  fs::path file() const { return folder_.path() / "station.toml"; }
  StationFile station() const { return read_station_file(file()); }

  int set_up(const std::string& answers, const std::string& step = {}) {
    std::istringstream in(answers);
    std::ostringstream out;
    const int status = run_setup({file().string(), step}, tools_, in, out);
    said_ = out.str();
    return status;
  }
  bool was_said(const std::string& text) const { return said_.find(text) != std::string::npos; }

  // Of the first tray; 0 where it was not said.
  double all_food_ml() const {
    const std::string before = "All food: ";
    const std::size_t at = said_.find(before);
    return at == std::string::npos ? 0.0 : std::stod(said_.substr(at + before.size()));
  }

  // What the programs beside do with pictures, done from what the demo knows.
  int play_program(const std::string& name, const std::vector<std::string>& arguments) {
    called_.push_back(name + " " + arguments[0]);
    if (calls_that_fail_ > 0) {
      --calls_that_fail_;
      return kExitNotMeasurable;
    }
    if (arguments[0] == "card") {
      fs::copy_file(kDemo / "card.png", folder_.path() / "card.png", fs::copy_options::overwrite_existing);
    } else if (arguments[0] == "lens") {
      pictures_ += std::distance(fs::directory_iterator(arguments[2]), fs::directory_iterator());
      LensConfig lens{read_capture(kDemo).views[0].camera, {}, {}, "2026-11-28", 0.31, {}};
      write_station_table(file(), "lens", compose_lens_table("lens", lens, ""));
    } else {
      moves_ += static_cast<long>(arguments.size()) - 2;
      const ArmGeometry geometry{kSecondViewDeg, {kSecondViewDeg, 0.0, 0.0}, {0.0, 130.0, 20.0}};
      write_station_table(file(), "arm_geometry", compose_arm_geometry_table(geometry, ""));
    }
    return kExitMeasured;
  }

  TemporaryFolder folder_;
  bool has_arm_;
  std::unique_ptr<MeasurableCaptures> captures_ = open_recorded_captures({kDemo}, {});
  std::deque<DeviceCode> camera_faults_;  // of each opening, the first first
  CameraList cameras_;
  SetupTools tools_;
  int calls_that_fail_ = 0;
  std::vector<std::string> called_;
  long pictures_ = 0;
  long moves_ = 0;
  std::string said_;
};

// Camera 2, the lamp lit, paper a4, the card's size, corners 9x6, card laid down, dish, a hub, its name and
// folder.
const std::string kAnswers = "2\n\n\n85.6x53.98x0.2\n\n\ndinner\n\nbar\n\n";

TEST_F(Setup, LeadsFromAFileWithWiresToAMeasuredTray) {
  ASSERT_EQ(set_up(kAnswers), kExitMeasured) << said_;
  EXPECT_EQ(called_, (std::vector<std::string>{"traygauge-card card", "traygauge-calibrate lens",
                                               "traygauge-calibrate arm"}));
  EXPECT_EQ(pictures_, 3);
  EXPECT_EQ(moves_, 5);
  const StationFile written = station();
  EXPECT_EQ(written.camera.device, "serial:A1");
  EXPECT_EQ(written.card->width_mm, 85.6);
  EXPECT_EQ(written.card->thickness_mm, 0.2);
  EXPECT_TRUE(written.lens.has_value());
  EXPECT_TRUE(written.arm_geometry.has_value());
  EXPECT_EQ(written.dishes, std::vector<std::string>{"dinner"});
  EXPECT_EQ(written.handover->name, "bar");
  EXPECT_TRUE(written.has_hub);
  EXPECT_NEAR(all_food_ml(), kTrueMl, 0.05 * kTrueMl) << said_;
  EXPECT_TRUE(was_said("Card and dish 1 agree about the scale to 0.")) << said_;
  EXPECT_TRUE(was_said("volumes right to 0.31 %")) << said_;
  EXPECT_TRUE(was_said("The station is set up.")) << said_;
  const std::string text = read_text(file());
  EXPECT_TRUE(text.starts_with("# My station.\n[camera]\ndevice = \"serial:A1\"  # the one above the tray\n"))
      << text;
}

TEST_F(Setup, WhatIsDoneIsKeptByEnterAlone) {
  ASSERT_EQ(set_up(kAnswers), kExitMeasured) << said_;
  const std::string before = read_text(file());
  called_.clear();
  EXPECT_EQ(set_up("\n\n\n\n\n\n\n\n\n"), kExitMeasured) << said_;
  EXPECT_EQ(read_text(file()), before);
  EXPECT_TRUE(called_.empty());
}

TEST_F(Setup, EndsAnywhereAndGoesOnFromThere) {
  std::size_t end = 0;
  while ((end = kAnswers.find('\n', end)) != kAnswers.size() - 1) {
    write_text(file(), std::string(kStation) + kArm);
    fs::remove(folder_.path() / "card.png");
    EXPECT_EQ(set_up(kAnswers.substr(0, end)), kExitNotMeasurable) << said_;
    EXPECT_TRUE(was_said("Ended at step ")) << said_;
    static_cast<void>(station());
    ++end;
  }
}

TEST_F(Setup, AStepThatFailsSaysWhyAndIsTriedAgainOrLeftOut) {
  camera_faults_ = {DeviceCode::in_use, DeviceCode::ok};
  EXPECT_EQ(set_up("\n\n\n", "camera"), kExitMeasured) << said_;
  EXPECT_TRUE(was_said(sentence(DeviceCode::in_use))) << said_;

  camera_faults_ = {DeviceCode::device_gone};
  cameras_ = {};
  EXPECT_EQ(set_up("s\n", "camera"), kExitNotMeasurable);
  EXPECT_TRUE(was_said("No camera is connected.") && was_said("Left out: camera")) << said_;

  cameras_.closed_node = "/dev/video0";
  cameras_.closed_status = DeviceCode::no_permission;
  EXPECT_EQ(set_up("", "camera"), kExitMeasured);
  EXPECT_TRUE(was_said("/dev/video0 could not be opened")) << said_;
}

TEST_F(Setup, TheCardNeedsASizeThatAPrintCanHave) {
  EXPECT_EQ(set_up("a5\na4\n8.5x5.4x0.1\n85.6x53.98\n83.0x52.4x1.0\n85.4x53.9x1.0\n", "card"), kExitMeasured)
      << said_;
  EXPECT_TRUE(was_said("Type a4 or letter.") && was_said("centimetres") &&
              was_said("The thickness is missing") && was_said("fit to page"))
      << said_;
  EXPECT_EQ(station().card->height_mm, 53.9);
  EXPECT_EQ(set_up("n\n\n", "card"), kExitNotMeasurable);  // another card, measured later
  EXPECT_EQ(station().card->height_mm, 53.9);
}

TEST_F(Setup, ALensThatIsNotGoodEnoughGetsMorePictures) {
  calls_that_fail_ = 1;
  EXPECT_EQ(set_up("9x6\n\n9x6\n", "lens"), kExitMeasured) << said_;
  EXPECT_EQ(pictures_, 5);
}

TEST_F(Setup, WithoutLensAndCardNothingIsMeasuredAndItIsSaid) {
  for (const char* step : {"view", "arm", "tray"}) {
    EXPECT_EQ(set_up("\ns\ns\n", step), kExitNotMeasurable) << step;
    EXPECT_TRUE(was_said("[lens]") || was_said("lens")) << said_;
    EXPECT_TRUE(was_said("Left out: ")) << said_;
  }
}

TEST_F(Setup, ADishThatIsNotKnownIsAskedForAgain) {
  EXPECT_EQ(set_up("saucer\ndinner soup\n", "dishes"), kExitMeasured) << said_;
  EXPECT_TRUE(was_said("There is no dish saucer."));
  EXPECT_EQ(station().dishes, (std::vector<std::string>{"dinner", "soup"}));
  EXPECT_EQ(set_up("any\n", "dishes"), kExitMeasured);
  EXPECT_TRUE(station().dishes.empty());
}

TEST_F(Setup, ResultsGoToAHubOrArePrintedAlone) {
  EXPECT_EQ(set_up("n\n", "hub"), kExitMeasured);
  EXPECT_FALSE(station().handover.has_value());
  EXPECT_EQ(set_up("y\nKitchen 1\nkitchen-1\n" + (folder_.path() / "kept").string() + "\n", "hub"),
            kExitMeasured);
  EXPECT_TRUE(was_said("Expected 1 to 32 of a-z")) << said_;
  EXPECT_EQ(station().handover->socket, folder_.path() / "kept" / "hub");
  EXPECT_EQ(read_hub_file(file(), file()).hub.store, folder_.path() / "kept" / "results.db");
  EXPECT_EQ(set_up("n\nbar\n\n", "hub"), kExitMeasured);
  EXPECT_EQ(station().handover->socket, "/run/traygauge/hub");  // as the units have it
}

// The demo's dish is full of food, and plain: it cannot be learnt, and nothing is left behind.
TEST_F(Setup, ADishThatCannotBeLearntIsToldAndLeftOut) {
  ASSERT_EQ(set_up(kAnswers), kExitMeasured) << said_;
  EXPECT_EQ(set_up("new\nmine\n1x1x1\n\nmine\n262x262x22\ns\n", "dishes"), kExitNotMeasurable) << said_;
  EXPECT_TRUE(was_said("such as 262x262x23")) << said_;
  EXPECT_FALSE(fs::exists(folder_.path() / "dishes" / "mine.toml"));
  EXPECT_EQ(set_up("\n", "dishes"), kExitMeasured);
}

TEST_F(Setup, WrongUseIsTold) {
  EXPECT_THROW(set_up("", "cards"), UsageError);
  write_text(file(), "[camera]\n");
  EXPECT_THROW(set_up(""), InputError);
}

class SetupByHand : public Setup {
 protected:
  SetupByHand() : Setup(false) {}
};

TEST_F(SetupByHand, AHandMovesTheCamera) {
  ASSERT_EQ(set_up(kAnswers), kExitMeasured) << said_;
  EXPECT_TRUE(was_said("a hand moves the camera")) << said_;
  EXPECT_NEAR(all_food_ml(), kTrueMl, 0.05 * kTrueMl) << said_;
}

// Whatever is typed, it ends, and the file stays one that a station reads.
TEST_F(Setup, AnyAnswersEnd) {
  std::mt19937 random(test::random_seed());
  const std::vector<std::string> words = {
      "",           "",   "",   "y",    "n",        "s",       "q",   "1",
      "2",          "99", "a4", "9x6",  "dinner",   "any",     "new", "85.4x53.9x1.0",
      "262x262x22", "x",  "-1", "mine", "\xff\xfe", "../../x", "\"]", "[camera]"};
  for (int run = 0; run < 5; ++run) {
    write_text(file(), std::string(kStation) + kArm);
    std::string answers;
    for (int i = 0; i < 40; ++i)
      answers += words[std::uniform_int_distribution<std::size_t>(0, words.size() - 1)(random)] + "\n";
    calls_that_fail_ = static_cast<int>(random() % 2);
    SCOPED_TRACE(answers);
    const int status = set_up(answers);
    EXPECT_TRUE(status == kExitMeasured || status == kExitNotMeasurable);
    static_cast<void>(station());
  }
}

}  // namespace
}  // namespace traygauge
