// The survey of a dish on path-traced captures: with food on it, so that only sizes and what is left to see
// can be compared; and what an enrolled dish does to volumes.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/enrolment/dish_survey.hpp"
#include "firmware/base/aligned_block.hpp"
#include "firmware/config/dish_file.hpp"
#include "firmware/measure/capture_session.hpp"
#include "tests/firmware/command_runner.hpp"
#include "tests/support/empty_dish.hpp"

namespace traygauge {
namespace {

// One pair through a surveyor, which takes food for something in the way.
class Survey {
 public:
  Survey(const Capture& capture, std::array<int, 2> pair)
      : views_{load_view(capture.views[static_cast<std::size_t>(pair[0])]),
               load_view(capture.views[static_cast<std::size_t>(pair[1])])},
        setup_(set_up_pair(capture, pair, {})),
        block_(survey_bytes(configure(setup_))),
        surveyor_(block_.bytes(), configure(setup_)) {
    for (std::size_t i = 0; i < 2; ++i) {
      ViewInput input;
      input.frame = views_[i].picture.frame();
      input.labels = views_[i].labels.gray();
      input.lens = setup_.lenses[i];
      EXPECT_TRUE(surveyor_.add_view(input).ok());
    }
    survey_ = &surveyor_.survey(1);
  }
  const DishSurvey& result() const { return *survey_; }
  std::span<const InsetRing> rings() const { return surveyor_.rings(); }

 private:
  std::array<LoadedView, 2> views_;
  PairSetup setup_;
  AlignedBlock block_;
  DishSurveyor surveyor_;
  const DishSurvey* survey_ = nullptr;
};

TEST(DishSurveyOfCaptures, SizeAndEdgeNeedNoDescription) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  for (const char* name : {"meals/m01", "meals/m04", "meals/m06", "meals/m08", "meals/m11",
                           "plates/c1_dinner", "plates/c1_soup", "plates/c1_oval"}) {
    SCOPED_TRACE(name);
    const Capture capture = read_capture(captures_folder() / name);
    const DishDescription& truth = capture.dishes.front();
    for (const std::array<int, 2>& pair : capture.pairs) {
      const Survey survey(capture, pair);
      const DishPose& place = survey.result().place;
      const auto [low, high] = std::minmax(place.size_mm[0], place.size_mm[1]);
      EXPECT_NEAR(low, std::min(truth.outer_size_mm[0], truth.outer_size_mm[1]), 0.15);
      EXPECT_NEAR(high, std::max(truth.outer_size_mm[0], truth.outer_size_mm[1]), 0.15);
      EXPECT_NEAR(place.edge_height_mm, truth.profile.front().height_mm, 0.25);
    }
  }
}

// The decorated plate of m08: its wall is free of food.
TEST(DishSurveyOfCaptures, HeightsOfAPathTracedGlaze) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  const Capture capture = read_capture(captures_folder() / "meals" / "m08");
  DishProfile truth;
  ASSERT_TRUE(truth.set(dish_of(capture.dishes.front())).ok());
  for (const std::array<int, 2>& pair : capture.pairs) {
    const Survey survey(capture, pair);
    int compared = 0;
    double squares = 0.0;
    for (const InsetRing& ring : survey.rings()) {
      if (!ring.is_known || ring.inset_mm < 6.0 || ring.inset_mm > 45.0) continue;
      const double off_mm = ring.height_mm - truth.height_at_inset_mm(ring.inset_mm);
      EXPECT_LT(std::abs(off_mm), 0.25) << ring.inset_mm;
      squares += off_mm * off_mm;
      ++compared;
    }
    EXPECT_GT(compared, 35);
    EXPECT_LT(std::sqrt(squares / compared), 0.1);
  }
}

TEST(DishSurveyOfCaptures, AnEnrolledDishMeasuresLikeItsTrueDescription) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  const TemporaryFolder out;
  for (const std::string style : {"dinner", "soup", "oval"}) {
    SCOPED_TRACE(style);
    test::EmptyDishScene scene;
    scene.dish = test::read_dish_model(style);
    scene.glaze_contrast = 0.5;
    const test::EmptyDishCapture empty(scene);
    const CommandResult enrolled =
        run({"enrol-dish", empty.folder().string(), "--style", style, "--out", out.path().string()});
    ASSERT_EQ(enrolled.status, 0) << enrolled.out << enrolled.error;

    const Capture capture = read_capture(captures_folder() / "plates" / ("c1_" + style));
    CaptureSession with_truth(capture, capture.pairs.front(), capture.dishes);
    CaptureSession with_enrolled(capture, capture.pairs.front(),
                                 {read_dish_file(out.path() / (style + ".toml"))});
    const Measurement& expected = with_truth.measure(1);
    const Measurement& measured = with_enrolled.measure(1);
    ASSERT_EQ(measured.items.size(), expected.items.size());
    for (std::size_t i = 0; i < measured.items.size(); ++i) {
      ASSERT_EQ(measured.items[i].status, StatusCode::ok);
      EXPECT_NEAR(measured.items[i].volume_ml / expected.items[i].volume_ml, 1.0, 0.015);
    }
  }
}

}  // namespace
}  // namespace traygauge
