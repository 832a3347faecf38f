// Outlines of cards in label pictures that OpenCV projected and filled.
#include "core/card/card_outline.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "core/card/card_hypotheses.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/cameras.hpp"
#include "tests/support/opencv_camera.hpp"
#include "tests/support/pictures.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

const CardModelSize kOutlinedCard{};

// A labelled card on the table, and the rays of its print's corners.
struct OutlinedCard {
  LensModel lens = test::phone_lens(0.5);
  cv::Mat1b labels = cv::Mat1b(600, 800, kBackgroundLabel);
  std::array<Vec2, 4> rays;
  Pose camera;

  explicit OutlinedCard(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    camera = test::camera_above(0.05 + 0.6 * unit(random), 6.28 * unit(random), 300.0 + 250.0 * unit(random));
    const double turn = 6.28 * unit(random);
    const Vec2 middle(40.0 * unit(random) - 20.0, 40.0 * unit(random) - 20.0);
    std::vector<cv::Point3d> border;
    const std::array<Vec2, 4> corners = print_corners_mm(kOutlinedCard);
    constexpr int kParts = 64;  // of a side: the lens bends it
    for (std::size_t i = 0; i < 4; ++i) {
      for (int k = 0; k < kParts; ++k) {
        const Vec2 at = corners[i] + k * (corners[(i + 1) % 4] - corners[i]) / kParts -
                        0.5 * Vec2(kOutlinedCard.width_mm, kOutlinedCard.height_mm);
        const Vec2 turned(std::cos(turn) * at.x() + std::sin(turn) * at.y(),
                          std::sin(turn) * at.x() - std::cos(turn) * at.y());
        const Vec3 point(middle.x() + turned.x(), middle.y() + turned.y(), 0.0);
        border.emplace_back(point.x(), point.y(), point.z());
        if (k == 0) rays[i] = (camera * point).hnormalized();
      }
    }
    const Mat3& r = camera.rotation;
    const cv::Matx33d rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1),
                               r(2, 2));
    cv::Vec3d axis;
    cv::Rodrigues(rotation, axis);
    std::vector<cv::Point2d> pixels;
    cv::projectPoints(border, axis,
                      cv::Vec3d(camera.translation.x(), camera.translation.y(), camera.translation.z()),
                      test::camera_matrix(lens.pinhole), test::distortion_of(lens), pixels);
    std::vector<cv::Point> fine;  // in sixteenths
    for (const cv::Point2d& pixel : pixels)
      fine.emplace_back(cvRound(16.0 * pixel.x), cvRound(16.0 * pixel.y));
    // Pixels whose centres lie inside: drawn eight times as large and read at the centres.
    cv::Mat1b large(8 * labels.rows, 8 * labels.cols, std::uint8_t{0});
    for (cv::Point& pixel : fine) pixel = {8 * pixel.x + 64, 8 * pixel.y + 64};  // centres at 8 x + 4
    cv::fillPoly(large, std::vector<std::vector<cv::Point>>{fine}, cv::Scalar(kCardLabel), 8, 4);
    for (int y = 0; y < labels.rows; ++y) {
      for (int x = 0; x < labels.cols; ++x) labels(y, x) = large(8 * y + 4, 8 * x + 4);
    }
  }
  Result<CardOutline> find() const {
    test::Allocated<CardOutlineWorkspace> space(CardOutlineParams{});
    return find_card_outline(test::view_of(labels), measure_regions(test::view_of(labels)).card, lens, {},
                             *space);
  }
  // The farthest corner, in pixels, whichever comes first.
  double off_px(const CardOutline& outline) const {
    double least = 1e9;
    for (std::size_t turn = 0; turn < 4; ++turn) {
      double most = 0.0;
      for (std::size_t i = 0; i < 4; ++i)
        most =
            std::max(most, (outline.corners[(i + turn) % 4] - rays[i]).norm() * lens.pinhole.mean_focal_px());
      least = std::min(least, most);
    }
    return least;
  }
};

TEST(CardOutline, HasTheCornersOfTheCardClockwise) {
  std::mt19937 random(test::random_seed());
  for (int round = 0; round < 40; ++round) {
    const OutlinedCard card(random);
    const Result<CardOutline> outline = card.find();
    ASSERT_TRUE(outline.ok());
    EXPECT_LT(card.off_px(*outline), 1.0);
    for (const double support : outline->support) EXPECT_GT(support, 0.9);
    double area = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
      area += 0.5 * cross(outline->corners[i], outline->corners[(i + 1) % 4]);
    EXPECT_GT(area, 0.0);  // y points down
  }
}

// A fork across it, or a napkin on a corner, changes little.
TEST(CardOutline, IsThatOfTheWholeCardThoughPartIsCovered) {
  std::mt19937 random(test::random_seed());
  for (int round = 0; round < 40; ++round) {
    OutlinedCard card(random);
    const Vec2 corner = card.lens.pixel(card.rays[static_cast<std::size_t>(round % 4)]);
    const Vec2 opposite = card.lens.pixel(card.rays[static_cast<std::size_t>((round + 2) % 4)]);
    if (round % 2 == 0) {
      const Vec2 middle = 0.5 * (corner + opposite);
      const Vec2 across(-(opposite - corner).y(), (opposite - corner).x());
      cv::line(card.labels, {cvRound(middle.x() - across.x()), cvRound(middle.y() - across.y())},
               {cvRound(middle.x() + across.x()), cvRound(middle.y() + across.y())}, cv::Scalar(0), 5);
    } else {
      cv::circle(card.labels, {cvRound(corner.x()), cvRound(corner.y())}, 14, cv::Scalar(0), cv::FILLED);
    }
    const Result<CardOutline> outline = card.find();
    ASSERT_TRUE(outline.ok());
    EXPECT_LT(card.off_px(*outline), 1.5) << round;
  }
}

TEST(CardOutline, IsNoneWithoutACard) {
  std::mt19937 random(4);
  OutlinedCard card(random);
  card.labels.setTo(0);
  EXPECT_EQ(card.find().code(), StatusCode::card_not_found);
  card.labels(cv::Rect(100, 100, 10, 6)).setTo(kCardLabel);
  EXPECT_EQ(card.find().code(), StatusCode::card_not_found);
  card.labels.setTo(0);
  card.labels(cv::Rect(100, 100, 60, 1)).setTo(kCardLabel);
  const Result<CardOutline> line = card.find();
  if (line.ok()) {
    for (const Vec2& corner : line->corners) EXPECT_TRUE(corner.allFinite());
  }
}

}  // namespace
}  // namespace traygauge
