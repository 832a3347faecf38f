// A station's file: what a person may write, and what they are told when it is wrong.
#include "firmware/config/station_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <regex>

#include "firmware/config/dish_choice.hpp"
#include "firmware/config/dish_library.hpp"
#include "firmware/config/station_writing.hpp"
#include "simulator/capture/input_error.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

constexpr const char* kSmallest = "[camera]\ndevice = \"serial:A1\"\n[button]\nline = \"TRIGGER\"\n";
constexpr const char* kStepper =
    "[arm]\nkind = \"stepper\"\nstep = \"a\"\ndirection = \"b\"\nhome = \"gpiochip1/4\"\nsteps_per_deg = "
    "20\n";
constexpr const char* kLamp =
    "[lamp]\nlines = [\"G\", \"Y\"]\nready = [\"G\"]\nhold_still = [\"Y\"]\nbusy = [\"G\", \"Y\"]\ndone = "
    "[\"G\"]\n"
    "try_again = [\"Y\"]\nfault = []\n";

class StationFileTest : public testing::Test {
 protected:
  StationFile read(const std::string& text) {
    write_text(file(), text);
    return read_station_file(file());
  }
  // What the reader says.
  std::string problem(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(file().string().size());
    }
    return "nothing";
  }
  std::filesystem::path file() const { return folder_.path() / "station.toml"; }

  TemporaryFolder folder_;
};

TEST_F(StationFileTest, TheOneThatIsShippedIsReadable) {
  const StationFile station =
      read_station_file(std::filesystem::path(TRAYGAUGE_SOURCE_DIR) / "config/station.toml");
  EXPECT_EQ(station.camera.device, "/dev/video0");
  EXPECT_EQ(station.lamp.lines.size(), 3U);
  EXPECT_FALSE(station.arm);
  for (const ControlWish& wish : station.camera.controls) EXPECT_EQ(wish.kind, ControlWish::Kind::hold);
}

TEST_F(StationFileTest, ALensMayHaveMoreCoefficientsOrAFileOfItsOwn) {
  const std::string values = "[lens]\nfx = 1400\nfy = 1401\ncx = 800\ncy = 600\ndistortion = ";
  const std::string camera = "width = 1600\nheight = 1200\n";
  const std::string head = "[camera]\ndevice = \"serial:A1\"\n" + camera + "[button]\nline = \"TRIGGER\"\n";
  const StationFile rational = read(head + values + "[[0.1, 0.2, 0, 0, 0.3, 0.4, 0.5, 0.6]]\n");
  EXPECT_EQ(rational.lens->camera.further_distortion[2], 0.6);
  const std::string written = compose_lens_table("lens", *rational.lens, "");
  EXPECT_EQ(read(head + written).lens->camera.coefficients(), rational.lens->camera.coefficients());
  EXPECT_FALSE(rational.lens->grade_percent);
  LensConfig graded = *rational.lens;
  graded.grade_percent = 0.31;
  EXPECT_EQ(read(head + compose_lens_table("lens", graded, "")).lens->grade_percent, 0.31);
  EXPECT_NE(problem(head + written + "grade_percent = 101\n").find("lens.grade_percent: expected"),
            std::string::npos);
  write_text(folder_.path() / "camera.yml",
             "image_width: 1600\nimage_height: 1200\nK: [1400, 0, 800, 0, 1401, 600, 0, 0, 1]\n"
             "D: [0.1, 0.2, 0, 0]\n");
  const StationFile named = read(head + "[lens]\nfile = \"camera.yml\"\nfocus = 30\n");
  EXPECT_EQ(named.lens->camera.fy_px, 1401.0);
  EXPECT_EQ(named.lens->camera.distortion[1], 0.2);
  EXPECT_EQ(named.lens->focus, 30);
  EXPECT_NE(problem(head + "[lens]\nfile = \"camera.yml\"\nfx = 3\n").find("no value beside file"),
            std::string::npos);
  EXPECT_THROW(read(head + "[lens]\nfile = \"absent.yml\"\n"), InputError);
  EXPECT_NE(problem(head + "[lens]\nfx = 4.2\nfy = 4.2\ncx = 800\ncy = 600\ndistortion = [0, 0, 0, 0]\n")
                .find("lens.fx: expected a focal length in pixels"),
            std::string::npos);
}

TEST_F(StationFileTest, TheOneThatIsShippedExplainsEveryKey) {
  const auto read_all = [](const char* path) {
    std::ifstream stream(std::filesystem::path(TRAYGAUGE_SOURCE_DIR) / path);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  // The sections, as "[arm] … key …" where the reader accepts the key.
  const std::string shipped = read_all("config/station.toml");
  const std::string reader =
      read_all("firmware/config/station_file.cpp") + read_all("firmware/config/hub_tables.cpp");
  const std::regex list(R"(expect\((\w+),\s*\{([^}]*)\}\))");
  const std::regex word("\"(\\w+)\"");
  int keys = 0;
  for (std::sregex_iterator at(reader.begin(), reader.end(), list), end; at != end; ++at) {
    const std::string names = (*at)[2];
    for (std::sregex_iterator key(names.begin(), names.end(), word); key != end; ++key) {
      ++keys;
      const std::string name = (*key)[1];
      const std::string as_key = "(^|\n)(# )?" + name + " = ";
      const bool may_be_table = (*at)[1] == "root";
      const std::regex explained(may_be_table ? "\\[" + name + "\\]|" + as_key : as_key);
      EXPECT_TRUE(std::regex_search(shipped, explained)) << name;
    }
  }
  EXPECT_GT(keys, 70);
}

TEST_F(StationFileTest, TheSmallestHasACameraAndAButton) {
  const StationFile station = read(kSmallest);
  EXPECT_EQ(station.camera.device, "serial:A1");
  EXPECT_EQ(station.camera.mode.width, 1600);
  EXPECT_EQ(station.button.line.line, "TRIGGER");
  EXPECT_TRUE(station.button.line.is_active_low);
  EXPECT_TRUE(station.lamp.lines.empty());
  EXPECT_THROW(require_geometry(station), InputError);
}

TEST_F(StationFileTest, EveryKeyArrives) {
  const StationFile station = read(
      "[camera]\ndevice = \"name:Doc Cam\"\nwidth = 640\nheight = 480\nformat = \"NV12\"\nframes_per_s = "
      "7.5\n"
      "exposure_us = 12000\ngain = \"leave\"\nwhite_balance_k = \"hold\"\nfocus = 30\nsettle_frames = 4\n"
      "burst = 5\nmay_repeat = true\n[button]\nline = \"x/3\"\nactive_low = false\nbias = \"pull-down\"\n"
      "debounce_ms = 12.5\nleast_closed_ms = 2.5\nstuck_after_s = 7\n" +
      std::string(kLamp) + kStepper +
      "enable = \"e\"\ninverted = [\"e\"]\nhome_bias = \"pull-up\"\nmax_deg = 30\nsecond_view_deg = 15\n"
      "speed_deg_per_s = 11\nacceleration_deg_per_s2 = 12\nhoming_speed_deg_per_s = 3\nhome_overlap_deg = "
      "1.5\n"
      "settling_ms = 250\n[lens]\nfx = 600\nfy = 601\ncx = 320\ncy = 240\ndistortion = [1, 2, 3, 4, "
      "5]\nfocus = 30\n"
      "[card]\npattern = \"p.png\"\nwidth_mm = 80\nheight_mm = 50\nthickness_mm = 1\n"
      "[trays]\nlabels = [\"a.png\", \"b.png\"]\n");
  EXPECT_EQ(station.camera.mode.format, "NV12");
  EXPECT_EQ(station.camera.mode.frames_per_s, 7.5);
  const auto& controls = station.camera.controls;
  EXPECT_EQ(controls[0].kind, ControlWish::Kind::value);
  EXPECT_EQ(controls[0].value, 12'000);
  EXPECT_EQ(controls[1].kind, ControlWish::Kind::leave);
  EXPECT_EQ(controls[2].kind, ControlWish::Kind::hold);
  EXPECT_EQ(controls[3].value, 30);
  EXPECT_EQ(station.camera.settle_frames, 4);
  EXPECT_EQ(station.camera.burst, 5);
  EXPECT_TRUE(station.camera.may_repeat);
  EXPECT_FALSE(station.button.line.is_active_low);
  EXPECT_EQ(station.button.line.bias, GpioBias::pull_down);
  EXPECT_EQ(station.button.debounce, std::chrono::microseconds(12'500));
  EXPECT_EQ(station.button.least_closed, std::chrono::microseconds(2500));
  EXPECT_EQ(station.button.stuck_after, std::chrono::seconds(7));
  EXPECT_EQ(station.lamp.table, (LampTable{0, 1, 2, 3, 1, 2, 2, 1, 2, 0}));
  const auto& stepper = std::get<StepperConfig>(station.arm->kind);
  EXPECT_EQ(stepper.home.line, "gpiochip1/4");
  EXPECT_EQ(stepper.home.bias, GpioBias::pull_up);
  EXPECT_TRUE(stepper.enable->is_active_low);
  EXPECT_FALSE(stepper.step.is_active_low);
  EXPECT_EQ(stepper.motion.steps_per_deg, 20.0);
  EXPECT_EQ(stepper.motion.limits.max_deg, 30.0);
  EXPECT_EQ(stepper.motion.settling_time, std::chrono::milliseconds(250));
  EXPECT_EQ(station.arm->second_view_deg, 15.0);
  EXPECT_EQ(station.lens->camera.fy_px, 601.0);
  EXPECT_EQ(station.lens->focus, 30);
  EXPECT_EQ(station.card->pattern.path, folder_.path() / "p.png");
  EXPECT_EQ((*station.labels)[1].path, folder_.path() / "b.png");
  EXPECT_NO_THROW(require_geometry(station));
}

TEST_F(StationFileTest, ASerialArmIsAnother) {
  const StationFile station = read(std::string(kSmallest) +
                                   "[arm]\nkind = \"serial\"\ndevice = \"/dev/ttyS7\"\nbaud = 9600\n"
                                   "longest_move_s = 45\nsettling_ms = 100\n");
  EXPECT_EQ(std::get<SerialArmParams>(station.arm->kind).longest_move, std::chrono::seconds(45));
  EXPECT_EQ(std::get<SerialArmParams>(station.arm->kind).device, "/dev/ttyS7");
  EXPECT_EQ(std::get<SerialArmParams>(station.arm->kind).baud, 9600);
  EXPECT_EQ(station.arm->second_view_deg, 18.0);
}

TEST_F(StationFileTest, ASecondCameraHasALensOfItsOwn) {
  const std::string lens = "fx = 600\nfy = 601\ncx = 320\ncy = 240\ndistortion = [0, 0, 0, 0, 0]\n";
  const std::string card = "[card]\npattern = \"p.png\"\nwidth_mm = 80\nheight_mm = 50\nthickness_mm = 1\n";
  const std::string twin = std::string(kSmallest) + card +
                           "[second_camera]\ndevice = \"serial:A2\"\nwidth = 800\nheight = 600\n[lens]\n" +
                           lens;
  EXPECT_THROW(require_geometry(read(twin)), InputError);
  const StationFile station = read(twin + "[second_lens]\n" + lens);
  EXPECT_NO_THROW(require_geometry(station));
  EXPECT_EQ(station.second_camera->device, "serial:A2");
  EXPECT_EQ(station.second_lens->camera.size, (PictureSize{800, 600}));
}

TEST_F(StationFileTest, NamesTheKeyThatIsWrong) {
  const std::string small = kSmallest;
  for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
           {"[button]\nline = \"T\"\n", "camera"},
           {"[camera]\ndevice = \"video0\"\n[button]\nline = \"T\"\n", "camera.device"},
           {small + "lien = 3\n", "button.lien"},
           {small + "bias = \"up\"\n", "button.bias"},
           {small + "line2 = \"x/\"\n", "button.line2"},
           {small + "debounce_ms = 0\n", "button.debounce_ms"},
           {small + "active_low = 1\n", "button.active_low"},
           {"[camera]\ndevice = \"/dev/v\"\nfocus = \"auto\"\n[button]\nline = \"T\"\n", "camera.focus"},
           {"[camera]\ndevice = \"/dev/v\"\nformat = \"NV-12\"\n[button]\nline = \"T\"\n", "camera.format"},
           {"[camera]\ndevice = \"/dev/v\"\nburst = 9\n[button]\nline = \"T\"\n", "camera.burst"},
           {"[camera]\ndevice = \"/dev/v\"\n[button]\nline = \"gpiochip0/\"\n", "button.line"},
           {small + "[arm]\nkind = \"hydraulic\"\n", "arm.kind"},
           {small + kStepper + "second_view_deg = 60\n", "arm.second_view_deg"},
           {small + kStepper + "baud = 9600\n", "arm.baud"},
           {small + "[arm]\nkind = \"serial\"\ndevice = \"/dev/t\"\nbaud = 100000\n", "arm.baud"},
           {small + "[lamp]\nlines = [\"G\"]\nready = [\"B\"]\n", "lamp.ready[0]"},
           {small + "[lamp]\nlines = [\"G\"]\nready = [\"G\"]\n", "lamp.hold_still"},
           {small + "[trays]\nlabels = [\"a.png\"]\n", "trays.labels"},
           {small + "[trays]\nlabels = \"given\"\n", "trays.labels"},
           {small + "[trays]\ndishes = []\n", "trays.dishes"},
           {small + "[trays]\nitems = 0\n", "trays.items"},
           {small + "[trays]\nlabels = [\"a.png\", \"b.png\"]\nitems = 2\n", "trays.items"},
           {small + "[gps]\n", "gps"},
           {small + "[second_camera]\ndevice = \"serial:A1\"\n", "second_camera.device"},
           {small + kStepper + "[second_camera]\ndevice = \"serial:A2\"\n", "second_camera"},
       }) {
    const std::string found = problem(text);
    EXPECT_NE(found.find(": " + expected + ":"), std::string::npos) << expected << " in \"" << found << "\"";
  }
  EXPECT_NE(problem("[camera\n").find("correct line 1"), std::string::npos);
}

TEST_F(StationFileTest, WithoutLabelPicturesTheyAreFound) {
  for (const char* trays : {"", "[trays]\n", "[trays]\nlabels = \"automatic\"\n"})
    EXPECT_FALSE(read(std::string(kSmallest) + trays).labels) << trays;
  const StationFile station =
      read(std::string(kSmallest) + "[trays]\ndishes = [\"dinner\", \"soup\", \"dinner\"]\nitems = 4\n");
  EXPECT_EQ(station.items, 4);
  const std::vector<DishDescription> library =
      read_dish_library(std::filesystem::path(TRAYGAUGE_SOURCE_DIR) / "config");
  const std::vector<DishDescription> dishes = choose_tray_dishes(station, library);
  ASSERT_EQ(dishes.size(), 3U);
  EXPECT_EQ(dishes[0].label, 1);
  EXPECT_EQ(dishes[1].label, 201);
  EXPECT_EQ(dishes[2].label, 202);
  EXPECT_EQ(dishes[1].style, "soup");
  EXPECT_EQ(dishes[2].outer_size_mm, dishes[0].outer_size_mm);
  EXPECT_EQ(choose_tray_dishes(read(kSmallest), library).size(), library.size());
  const StationFile unknown = read(std::string(kSmallest) + "[trays]\ndishes = [\"dinner\", \"wok\"]\n");
  try {
    choose_tray_dishes(unknown, library);
    FAIL() << "took an unknown dish";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problem().key, "trays.dishes[1]");
    EXPECT_NE(std::string(error.what()).find("soup"), std::string::npos) << error.what();
  }
}

TEST_F(StationFileTest, SurvivesAnyText) {
  std::mt19937 random(20261122);
  const std::string good = std::string(kSmallest) + kLamp + kStepper;
  for (int run = 0; run < 500; ++run) {
    std::string text = good;
    for (int i = 0; i < 1 + run % 4; ++i) {
      const std::size_t at = random() % text.size();
      if (random() % 2 == 0) {
        text[at] = static_cast<char>(random() % 128);
      } else {
        text.erase(at, random() % 9);
      }
      if (text.empty()) text.push_back(10);
    }
    try {
      read(text);
    } catch (const InputError&) {  // said, not crashed
    }
  }
}

TEST_F(StationFileTest, GuidanceHasItsOwnLampsOrThoseOfTheSameMeaning) {
  const auto lit = [](const StationFile& station, Signal signal) {
    return station.lamp.table[static_cast<std::size_t>(signal)];
  };
  const StationFile plain = read(std::string(kSmallest) + kLamp);
  EXPECT_EQ(lit(plain, Signal::move_on), lit(plain, Signal::hold_still));
  EXPECT_EQ(lit(plain, Signal::far_enough), lit(plain, Signal::ready));
  EXPECT_EQ(lit(plain, Signal::too_far), lit(plain, Signal::try_again));
  const StationFile own =
      read(std::string(kSmallest) + kLamp + "move_on = []\nfar_enough = [\"G\"]\ntoo_far = [\"G\", \"Y\"]\n");
  EXPECT_EQ(lit(own, Signal::move_on), 0U);
  EXPECT_EQ(lit(own, Signal::far_enough), 1U);
  EXPECT_EQ(lit(own, Signal::too_far), 3U);
}

TEST_F(StationFileTest, ALongPressIsConfigured) {
  EXPECT_FALSE(read(kSmallest).long_press);
  EXPECT_EQ(read(std::string(kSmallest) + "long_press_s = 3\n").long_press, std::chrono::seconds(3));
  EXPECT_EQ(read(std::string(kSmallest) + "long_press_s = 0\n").long_press, Nanoseconds::zero());
  EXPECT_NE(
      problem(std::string(kSmallest) + "long_press_s = 0.1\n").find("button.long_press_s: expected 0, or"),
      std::string::npos);
}

constexpr const char* kLens =
    "[lens]\nfx = 600\nfy = 601\ncx = 320\ncy = 240\ndistortion = [0, 0, 0, 0, 0]\n";
constexpr const char* kCard =
    "[card]\npattern = \"p.png\"\nwidth_mm = 80\nheight_mm = 50\nthickness_mm = 1\n";

TEST_F(StationFileTest, SaysWhatHasChangedSinceTheLensWasCalibrated) {
  const auto change = [&](const std::string& camera, const std::string& lens, std::optional<int> focus = {}) {
    const StationFile station =
        read("[camera]\ndevice = \"serial:A1\"\n" + camera + "[button]\nline = \"TRIGGER\"\n" + kLens + lens);
    return find_lens_change(*station.lens, station.camera, focus);
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_EQ(change("", ""), "");
  EXPECT_EQ(change("lens_changed_on = \"2025-03-01\"\n",
                   "camera = \"serial:A1\"\ncalibrated_on = \"2025-03-01\"\nfocus = 30\n", 30),
            "");
  EXPECT_TRUE(has(change("", "width = 800\nheight = 600\n"), "800x600, the camera takes 1600x1200"));
  EXPECT_TRUE(has(change("", "camera = \"serial:B2\"\n"), "on camera serial:B2, this is serial:A1"));
  EXPECT_TRUE(has(change("lens_changed_on = \"2025-03-02\"\n", "calibrated_on = \"2025-03-01\"\n"),
                  "changed on 2025-03-02 and calibrated before, on 2025-03-01"));
  EXPECT_TRUE(has(change("lens_changed_on = \"2025-03-02\"\n", ""), "on an unknown day"));
  EXPECT_TRUE(has(change("", "focus = 30\n", 45), "at focus 30 and stands at 45"));
  EXPECT_TRUE(has(problem("[camera]\ndevice = \"serial:A1\"\nlens_changed_on = \"March\"\n[button]\nline = "
                          "\"TRIGGER\"\n" +
                          std::string(kLens)),
                  "lens_changed_on: expected a day"));
}

TEST_F(StationFileTest, ALensOfOtherPicturesMeasuresNothing) {
  require_geometry(read(std::string(kSmallest) + kLens + kCard));
  const StationFile other = read(std::string(kSmallest) + kLens + "width = 800\nheight = 600\n" + kCard);
  EXPECT_THROW(require_geometry(other), InputError);
}

TEST_F(StationFileTest, TheArmsGeometryIsAMove) {
  const std::string arm = "[arm_geometry]\ncommanded_deg = 18\nshift_mm = [0, 150, 20]\nturn_deg = ";
  const StationFile station = read(std::string(kSmallest) + arm + "[3, -18, 0]\n");
  ASSERT_TRUE(station.arm_geometry);
  EXPECT_NEAR(station.arm_geometry->angle_deg(), 18.248, 0.001);
  EXPECT_NE(
      problem(std::string(kSmallest) + arm + "[0, 0.1, 0]\n").find("arm_geometry.turn_deg: expected a turn"),
      std::string::npos);
}

}  // namespace
}  // namespace traygauge
