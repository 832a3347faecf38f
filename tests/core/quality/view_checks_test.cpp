// What is refused and what is warned of: pictures drawn good, then spoilt by OpenCV one way at a time.
#include "core/quality/view_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tests/support/allocated.hpp"
#include "tests/support/cameras.hpp"
#include "tests/support/pictures.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kCheckedItem = 2;

// A printed card and textured food on a dish, seen from above.
struct CheckedScene {
  cv::Mat3b picture = cv::Mat3b(600, 800, cv::Vec3b(90, 100, 110));
  cv::Mat1b labels = cv::Mat1b(600, 800, kBackgroundLabel);
  LensModel lens;

  CheckedScene() {
    lens.width = 800;
    lens.height = 600;
    lens.pinhole = {700.0, 700.0, 400.0, 300.0};
    const cv::Rect card(60, 60, 257, 162);  // 3 px/mm
    picture(card).setTo(cv::Scalar(205, 205, 205));
    labels(card).setTo(kCardLabel);
    // Discs: blur is measured along four directions, which their edges all have.
    for (int i = 0; i < 8; ++i)
      cv::circle(picture, {100 + 58 * (i % 4), 105 + 74 * (i / 4)}, 18, cv::Scalar(40, 40, 40), cv::FILLED,
                 cv::LINE_AA);
    cv::circle(picture, {530, 330}, 190, cv::Scalar(170, 175, 180), cv::FILLED);
    cv::circle(labels, {530, 330}, 190, cv::Scalar(kDishLabel), cv::FILLED);
    cv::circle(labels, {530, 330}, 90, cv::Scalar(kCheckedItem), cv::FILLED);
    cv::Mat3b food;
    cv::cvtColor(test::textured_picture(800, 600, 3), food, cv::COLOR_GRAY2BGR);
    food.convertTo(food, CV_8U, 0.5, 60.0);
    food.copyTo(picture, labels == kCheckedItem);
    cv::GaussianBlur(picture, picture, {}, 0.6);
  }
  ViewQuality assess() const {
    cv::Mat1b gray;
    cv::cvtColor(picture, gray, cv::COLOR_BGR2GRAY);
    const LabelRegions regions = measure_regions(test::view_of(labels));
    test::Allocated<CardSilhouetteWorkspace> space(600);
    ViewQuality quality;
    assess_view({test::frame_of(picture), test::view_of(gray), test::view_of(labels), &regions, &lens},
                {85.6, 53.98}, {}, *space, quality);
    return quality;
  }
};

struct Compared {
  StatusCode code = StatusCode::ok;
  PictureReport report;
  WarningSet warnings;
};

Compared compare(const ViewQuality& first, const ViewQuality& second) {
  Compared compared;
  compared.code = compare_pictures(first, second, {}, compared.report, compared.warnings).code();
  return compared;
}

TEST(ViewChecks, FindNothingWrongWithAGoodPicture) {
  const ViewQuality good = CheckedScene().assess();
  EXPECT_TRUE(good.has_card);
  EXPECT_NEAR(good.card_px_per_mm, 3.0, 0.01);
  EXPECT_GT(good.visible_card_fraction, 0.95);
  EXPECT_NEAR(good.card_edges.bright, 205, 2);
  EXPECT_TRUE(judge_view(good, {}).ok());
  EXPECT_EQ(judge_item_pixels(kCheckedItem, good, good, {}), StatusCode::ok);
  const Compared same = compare(good, good);
  EXPECT_EQ(same.code, StatusCode::ok);
  EXPECT_TRUE(same.warnings.empty());
  EXPECT_NEAR(same.report.exposure_ratio, 1.0, 1e-6);
  EXPECT_NEAR(same.report.white_balance_ratio, 1.0, 1e-6);
}

// The blur that OpenCV adds comes on top of what was there; a warning comes first, then a refusal.
TEST(ViewChecks, WarnOfBlurThenRefuseIt) {
  const ViewQuality good = CheckedScene().assess();
  const auto blurred_by = [](double sigma_px) {
    CheckedScene scene;
    cv::GaussianBlur(scene.picture, scene.picture, {}, sigma_px);
    return scene.assess();
  };
  const ViewQuality soft = blurred_by(2.0);
  EXPECT_NEAR(soft.card_edges.sigma_px, std::hypot(good.card_edges.sigma_px, 2.0), 0.25);
  EXPECT_NEAR(soft.blur_mm(), soft.card_edges.sigma_px / 3.0, 0.01);
  EXPECT_TRUE(judge_view(soft, {}).ok());
  EXPECT_TRUE(compare(good, soft).warnings.holds(Warning::blurred));
  EXPECT_TRUE(compare(soft, good).warnings.holds(Warning::blurred));
  EXPECT_EQ(judge_view(blurred_by(3.6), {}).code(), StatusCode::too_blurred);
}

TEST(ViewChecks, WarnOfDarkPicturesThenRefuseThem) {
  const ViewQuality good = CheckedScene().assess();
  const auto darkened_to = [](double fraction) {
    CheckedScene scene;
    scene.picture.convertTo(scene.picture, CV_8U, fraction);
    return scene.assess();
  };
  const ViewQuality dim = darkened_to(50.0 / 205.0);
  EXPECT_TRUE(judge_view(dim, {}).ok());
  EXPECT_TRUE(compare(good, dim).warnings.holds(Warning::underexposed));
  EXPECT_EQ(judge_view(darkened_to(20.0 / 205.0), {}).code(), StatusCode::frame_too_dark);
}

TEST(ViewChecks, RefuseACardThatIsCovered) {
  CheckedScene scene;
  const cv::Rect napkin(190, 40, 140, 110);  // a quarter of it, at a corner
  scene.labels(napkin).setTo(kBackgroundLabel);
  const ViewQuality covered = scene.assess();
  EXPECT_LT(covered.visible_card_fraction, 0.82);
  EXPECT_EQ(judge_view(covered, {}).code(), StatusCode::card_hidden);
  EXPECT_TRUE(compare(covered, CheckedScene().assess()).warnings.holds(Warning::card_partly_hidden));
  scene.labels.setTo(kBackgroundLabel, scene.labels == kCardLabel);
  const ViewQuality without = scene.assess();
  EXPECT_FALSE(without.has_card);
  EXPECT_TRUE(judge_view(without, {}).ok());  // that is for others to say
}

TEST(ViewChecks, RefuseFoodThatIsClippedOrWithoutTexture) {
  const ViewQuality good = CheckedScene().assess();
  CheckedScene burnt;
  cv::circle(burnt.picture, {530, 330}, 72, cv::Scalar(255, 255, 255), cv::FILLED);
  const ViewQuality clipped = burnt.assess();
  const Compared shining = compare(good, clipped);
  EXPECT_NEAR(shining.report.most_clipped_fraction, 72.0 * 72.0 / (90.0 * 90.0), 0.02);
  EXPECT_TRUE(shining.warnings.holds(Warning::food_clipped, kCheckedItem));
  EXPECT_FALSE(shining.warnings.holds(Warning::food_clipped, kCheckedItem + 1));
  EXPECT_EQ(judge_item_pixels(kCheckedItem, good, clipped, {}), StatusCode::item_clipped);
  EXPECT_EQ(judge_item_pixels(kCheckedItem, clipped, good, {}), StatusCode::item_clipped);
  CheckedScene painted;
  painted.picture.setTo(cv::Scalar(90, 120, 150), painted.labels == kCheckedItem);
  const ViewQuality smooth = painted.assess();
  EXPECT_EQ(judge_item_pixels(kCheckedItem, smooth, good, {}), StatusCode::item_textureless);
  EXPECT_TRUE(compare(good, smooth).warnings.holds(Warning::little_texture, kCheckedItem));
  EXPECT_EQ(judge_item_pixels(kCheckedItem + 1, smooth, clipped, {}), StatusCode::ok);  // not there
}

// Half the light is 255 · (v/255)^2.2 / 2 and so on: pictures of one scene with another exposure or lamp.
TEST(ViewChecks, CompareLightAndColourOfBothPictures) {
  const ViewQuality good = CheckedScene().assess();
  const auto lit = [](double blue, double green, double red) {
    CheckedScene scene;
    const std::array<double, 3> light = {blue, green, red};
    for (cv::Vec3b& pixel : scene.picture) {
      for (int i = 0; i < 3; ++i) {
        pixel[i] = cv::saturate_cast<std::uint8_t>(
            255.0 * std::pow(light[static_cast<std::size_t>(i)], 1.0 / 2.2) * (pixel[i] / 255.0));
      }
    }
    return scene.assess();
  };
  const Compared darker = compare(good, lit(0.35, 0.35, 0.35));
  EXPECT_EQ(darker.code, StatusCode::ok);
  EXPECT_NEAR(darker.report.exposure_ratio, 1.0 / 0.35, 0.3 / 0.35);
  EXPECT_TRUE(darker.warnings.holds(Warning::exposure_unequal));
  EXPECT_FALSE(darker.warnings.holds(Warning::white_balance_unequal));
  EXPECT_EQ(compare(lit(0.06, 0.06, 0.06), good).code, StatusCode::exposure_differs);
  const Compared warmer = compare(good, lit(0.55, 1.0, 1.0));
  EXPECT_NEAR(warmer.report.white_balance_ratio, 1.0 / 0.55, 0.2);
  EXPECT_TRUE(warmer.warnings.holds(Warning::white_balance_unequal));
  EXPECT_EQ(warmer.code, StatusCode::ok);
  EXPECT_EQ(compare(lit(0.25, 1.0, 1.0), good).code, StatusCode::white_balance_differs);
}

}  // namespace
}  // namespace traygauge
