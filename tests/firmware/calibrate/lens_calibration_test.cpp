// Lenses from boards against the lens that saw them, and whether the grade says how good they are.
#include "firmware/calibrate/lens_calibration.hpp"

#include <gtest/gtest.h>

#include "firmware/measure/pair_setup.hpp"
#include "tests/firmware/calibrate/board_views.hpp"

namespace traygauge {
namespace {

using namespace test;

const PictureSize kSize{1600, 1200};

struct Calibrated {
  bool works = false;
  LensCalibration lens;
  CalibrationProblem problem;
};

Calibrated calibrate(const std::vector<BoardSighting>& sightings) {
  Calibrated result;
  result.works = calibrate_lens(sightings, kBoard, kSize, {}, result.lens, result.problem);
  return result;
}

std::vector<BoardSighting> sight(const BoardHandling& handling, double noise_px, std::uint64_t seed) {
  std::vector<BoardSighting> sightings;
  for (const Pose& pose : hold_board(kBoard, phone_lens(), handling, seed))
    sightings.push_back(project_board(kBoard, phone_lens(), pose, noise_px, 100 * seed + sightings.size()));
  return sightings;
}

TEST(StandardMeal, TheTrueLensMeasuresTheTrueVolume) {
  const auto deviation = volume_deviation(phone_lens(), phone_lens(), {});
  ASSERT_TRUE(deviation);
  EXPECT_NEAR(*deviation, 0.0, 1e-6);
}

// The card seems farther away by as much as everything grows, which cancels most of it.
TEST(StandardMeal, AWrongFocalLengthIsAWrongVolumeInProportion) {
  const auto deviation = [](double share) {
    LensModel wrong = phone_lens();
    wrong.pinhole.fx_px *= 1.0 + share;
    wrong.pinhole.fy_px *= 1.0 + share;
    return volume_deviation(phone_lens(), wrong, {}).value();
  };
  EXPECT_GT(std::abs(deviation(0.01)), 0.003);
  EXPECT_LT(std::abs(deviation(0.01)), 0.02);
  EXPECT_NEAR(deviation(0.002), 0.2 * deviation(0.01), 2e-4);
  EXPECT_NEAR(deviation(-0.002), -deviation(0.002), 2e-4);
}

TEST(LensCalibration, ExactCornersGiveTheLens) {
  const Calibrated result = calibrate(sight({}, 0.0, 1));
  ASSERT_TRUE(result.works) << result.problem.expected;
  EXPECT_NEAR(result.lens.camera.fx_px, phone_lens().pinhole.fx_px, 0.2);
  EXPECT_NEAR(result.lens.camera.cy_px, phone_lens().pinhole.cy_px, 0.2);
  EXPECT_LT(result.lens.volume_percent, 0.02);
  EXPECT_TRUE(result.lens.left_out.empty());
}

// Two standard deviations: over many calibrations the true deviations of the volume must be as large as the
// grades say, within what so few can show.
TEST(LensCalibration, TheGradeIsWhatVolumesAreOff) {
  double squares_of_ratios = 0.0;
  double largest_ratio = 0.0;
  constexpr int kCalibrations = 8;
  for (std::uint64_t seed = 1; seed <= kCalibrations; ++seed) {
    const double noise_px = seed % 2 == 0 ? 0.1 : 0.4;
    const Calibrated result = calibrate(sight({13, 35.0, true}, noise_px, seed));
    ASSERT_TRUE(result.works) << "seed " << seed << ": " << result.problem.expected;
    const double percent = 100.0 * volume_deviation(phone_lens(), lens_of(result.lens.camera), {}).value();
    const double ratio = percent / (0.5 * result.lens.volume_percent);
    std::printf("seed %d, noise %.1f px: volumes %+.3f %% off, grade %.3f %%\n", static_cast<int>(seed),
                noise_px, percent, result.lens.volume_percent);
    squares_of_ratios += ratio * ratio;
    largest_ratio = std::max(largest_ratio, std::abs(ratio));
  }
  const double rms_ratio = std::sqrt(squares_of_ratios / kCalibrations);
  EXPECT_GT(rms_ratio, 0.4);
  EXPECT_LT(rms_ratio, 1.6);
  EXPECT_LT(largest_ratio, 4.0);
}

TEST(LensCalibration, MoreNoiseIsAWorseGrade) {
  const double good = calibrate(sight({}, 0.05, 5)).lens.volume_percent;
  const double bad = calibrate(sight({}, 1.0, 5)).lens.volume_percent;
  EXPECT_GT(bad, 5.0 * good);
  EXPECT_GT(bad, LensCalibrationParams{}.max_volume_percent);
}

TEST(LensCalibration, AMisreadBoardIsLeftOut) {
  auto sightings = sight({}, 0.1, 2);
  for (std::size_t i = 0; i < sightings.size(); ++i) sightings[i].picture = std::to_string(i);
  for (std::size_t i = 0; i < 9; ++i) sightings[4].corners_px[i] += Vec2(20.0, 5.0);
  const Calibrated result = calibrate(sightings);
  ASSERT_TRUE(result.works);
  EXPECT_EQ(result.lens.left_out, std::vector<std::string>{"4"});
  EXPECT_NEAR(result.lens.camera.fx_px, phone_lens().pinhole.fx_px, 3.0);
}

TEST(LensCalibration, TooFewPicturesAreRefused) {
  const Calibrated result = calibrate(sight({9, 35.0, true}, 0.1, 1));
  EXPECT_FALSE(result.works);
  EXPECT_EQ(result.problem.expected, "at least 10 pictures that show the whole board");
  EXPECT_EQ(result.problem.found, "9");
}

TEST(LensCalibration, BoardsThatAllFaceOneWayAreRefused) {
  for (const double tilt_deg : {0.0, 4.0}) {
    const Calibrated result = calibrate(sight({16, tilt_deg, true}, 0.1, 1));
    EXPECT_FALSE(result.works) << tilt_deg;
    EXPECT_NE(result.problem.expected.find("face different ways"), std::string::npos)
        << result.problem.expected;
  }
  // The same slant for all, turned about its own normal and shifted only.
  std::vector<BoardSighting> sightings;
  const auto poses = hold_board(kBoard, phone_lens(), {16, 0.0, true}, 7);
  for (const Pose& pose : poses) {
    Pose slanted = pose;
    slanted.rotation = rotation_about(Vec3(0.5, 0.2, 0.0)) * pose.rotation;
    sightings.push_back(project_board(kBoard, phone_lens(), slanted, 0.1, sightings.size()));
  }
  EXPECT_FALSE(calibrate(sightings).works);
}

TEST(LensCalibration, BoardsInTheMiddleOnlyAreRefused) {
  const Calibrated result = calibrate(sight({16, 35.0, false}, 0.1, 1));
  EXPECT_FALSE(result.works);
  EXPECT_NE(result.problem.expected.find("all over the picture"), std::string::npos)
      << result.problem.expected;
}

}  // namespace
}  // namespace traygauge
