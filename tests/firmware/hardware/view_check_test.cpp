// The card in pictures whose cameras are known, and what people are told of it.
#include "firmware/check/view_check.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "firmware/base/aligned_block.hpp"
#include "firmware/card/card_finder.hpp"
#include "firmware/card/card_guide.hpp"
#include "firmware/measure/pair_setup.hpp"

namespace traygauge {
namespace {

class CardInDemo : public testing::TestWithParam<const char*> {
 protected:
  CardInDemo() {
    std::ifstream file(folder_ / "truth.json");
    const auto truth = nlohmann::json::parse(file);
    for (std::size_t i = 0; i < 2; ++i) {
      pictures_[i] = load_view(capture_.views[i]).picture;
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
          truth_[i].rotation(row, column) =
              truth["poses"][i][static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
        truth_[i].translation[row] = truth["poses"][i][static_cast<std::size_t>(row)][3];
      }
    }
  }
  LensModel lens(std::size_t view) const { return lens_of(capture_.views[view].camera); }

  std::filesystem::path folder_ = std::filesystem::path(TRAYGAUGE_SOURCE_DIR) / "simulator/demo" / GetParam();
  Capture capture_ = read_capture(folder_);
  Picture pattern_ = load_pattern(capture_.card);
  ReferenceCard card_{{capture_.card.width_mm, capture_.card.height_mm, capture_.card.thickness_mm},
                      pattern_.gray()};
  std::array<Picture, 2> pictures_;
  std::array<Pose, 2> truth_;  // world to camera
};

TEST_P(CardInDemo, GivesTheMoveBetweenTheViews) {
  std::array<std::optional<Pose>, 2> seen;
  for (std::size_t i = 0; i < 2; ++i) {
    const CheckResult result = check_card(pictures_[i].frame(), lens(i), card_, seen[i]);
    ASSERT_TRUE(result.is_good) << result.text;
    ASSERT_TRUE(seen[i]);
  }
  const Pose found = second_from_first({*seen[0], *seen[1]});
  const Pose truth = second_from_first({truth_[0], truth_[1]});
  EXPECT_LT(Eigen::AngleAxisd(Mat3(found.rotation.transpose() * truth.rotation)).angle(), 0.2 * M_PI / 180.0);
  EXPECT_LT((found.translation - truth.translation).norm(), 2.0);
  EXPECT_TRUE(check_move(found, *capture_.views[1].arm_angle_deg, {}).is_good);
}

TEST_P(CardInDemo, GuidesAHand) {
  CardGuide guide;
  guide.begin(card_, lens(0), pictures_[0].frame());
  EXPECT_LT(guide.turned_deg(pictures_[0].frame()).value(), 0.01);
  // The world's table is z = 0, where the first view's axis meets it.
  const Vec3 centre = camera_centre_mm(truth_[0]);
  const Vec3 axis = truth_[0].rotation.row(2);
  const Vec3 aim = centre - axis * (centre.z() / axis.z());
  EXPECT_NEAR(guide.turned_deg(pictures_[1].frame()).value(),
              angle_between_views_deg({truth_[0], truth_[1]}, aim), 0.2);
  EXPECT_FALSE(guide.turned_deg(Picture(capture_.views[0].camera.size, PixelFormat::rgb8).frame()));
  EXPECT_FALSE(guide.turned_deg(Picture({64, 64}, PixelFormat::rgb8).frame()));
  guide.begin(card_, lens(0), Picture(capture_.views[0].camera.size, PixelFormat::rgb8).frame());
  EXPECT_FALSE(guide.turned_deg(pictures_[1].frame()));
}

TEST_P(CardInDemo, GuidesAHandInLentMemory) {
  const PictureSize size = capture_.views[0].camera.size;
  const AlignedBlock lent(CardFinder::required_bytes(size.width, size.height));
  std::memset(lent.bytes().data(), 0x5C, lent.bytes().size());
  const auto guided = [&](CardGuide& guide, std::span<std::byte> memory) {
    guide.begin(card_, lens(0), pictures_[0].frame(), memory);
    return guide.turned_deg(pictures_[1].frame());
  };
  CardGuide own;
  CardGuide changing;
  const auto expected = guided(own, {});
  ASSERT_TRUE(expected);
  EXPECT_EQ(guided(changing, lent.bytes()), expected);
  EXPECT_EQ(guided(changing, lent.bytes().first(lent.bytes().size() - 64)), expected);  // too little
  EXPECT_EQ(guided(changing, lent.bytes()), expected);
}

INSTANTIATE_TEST_SUITE_P(Demo, CardInDemo, testing::Values("fish_and_potatoes", "mash_and_meatballs"));

TEST_P(CardInDemo, ACardOutOfViewIsTold) {
  Picture without = pictures_[0];
  std::fill(without.pixels.begin(), without.pixels.end(), std::uint8_t{120});
  std::optional<Pose> seen;
  const CheckResult result = check_card(without.frame(), lens(0), card_, seen);
  EXPECT_FALSE(result.is_good);
  EXPECT_FALSE(seen);
  EXPECT_TRUE(result.text.starts_with("The card is not in view")) << result.text;
}

TEST(MoveCheck, AnArmOrCameraThatSitsOtherwiseIsTold) {
  const auto move = [](double angle_deg, double shift_mm) {
    return Pose{rotation_about(Vec3::UnitX() * angle_deg * M_PI / 180.0), Vec3(0.0, 150.0 + shift_mm, 20.0)};
  };
  EXPECT_TRUE(check_move(move(18.3, 0.0), 18.0, {}).is_good);
  EXPECT_TRUE(check_move(move(18.3, 0.0), -18.0, {}).is_good);
  EXPECT_NE(check_move(move(18.6, 0.0), 18.0, {}).text.find("correct arm.steps_per_deg"), std::string::npos);
  const ArmGeometry geometry{18.0, {18.6, 0.0, 0.0}, {0.0, 150.0, 20.0}};
  EXPECT_TRUE(check_move(move(18.6, 0.0), 18.0, geometry).is_good);
  EXPECT_FALSE(check_move(move(18.0, 0.0), 18.0, geometry).is_good);
  const CheckResult elsewhere = check_move(move(20.6, 16.0), 20.0, geometry);
  EXPECT_FALSE(elsewhere.is_good);
  EXPECT_NE(elsewhere.text.find("was calibrated at 18.00 degrees"), std::string::npos) << elsewhere.text;
  EXPECT_FALSE(check_move(move(18.6, 12.0), 18.0, geometry).is_good);
}

}  // namespace
}  // namespace traygauge
