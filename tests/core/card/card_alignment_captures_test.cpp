// The camera's pose by the card's print, against the exact truth of the rendered captures.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "tests/core/card/card_render.hpp"
#include "tests/support/capture_bundle.hpp"

namespace traygauge {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

TEST(CardAlignmentCaptures, EveryViewOfEveryCapture) {
  const std::filesystem::path captures = test::captures_folder();
  if (captures.empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  CardAligner aligner;
  std::vector<double> corners_px;
  std::vector<double> normals_deg;
  std::vector<double> heights_mm;
  double normalised = 0.0;
  for (const char* set : {"angles", "meals", "plates", "trays"}) {
    for (const auto& folder : std::filesystem::directory_iterator(captures / set)) {
      const test::CaptureTruth capture = test::read_capture_truth(folder.path());
      const nlohmann::json& card = capture.description.at("card");
      const CardModelSize size{card.at("width_mm"), card.at("height_mm"), card.at("thickness_mm")};
      const auto pattern = folder.path() / card.at("pattern").get<std::string>();
      ASSERT_TRUE(aligner.set_pattern(cv::imread(pattern.string(), cv::IMREAD_GRAYSCALE), size).ok());
      for (const test::TrueView& view : capture.views) {
        const Result<CardAlignment> alignment =
            aligner.align(view.read_gray(), view.read_labels(), view.lens);
        ASSERT_TRUE(alignment.ok()) << view.image;
        const Pose truth =
            view.camera_from_world * test::table_frame_of(capture, size.thickness_mm).inverse();
        const CardPoseError error = compare_poses(*alignment, truth, size, view.lens.pinhole.mean_focal_px());
        EXPECT_LT(error.corner_rms_px, 0.1) << view.image;
        EXPECT_LT(error.normal_deg, 0.15) << view.image;
        EXPECT_LT(error.normalised_square, 30.0) << view.image;
        EXPECT_GT(alignment->visible_fraction, 0.9) << view.image;
        corners_px.push_back(error.corner_rms_px);
        normals_deg.push_back(error.normal_deg);
        heights_mm.push_back(error.height_200_mm);
        normalised += error.normalised_square;
      }
    }
  }
  ASSERT_FALSE(corners_px.empty());
  const double mean = normalised / static_cast<double>(corners_px.size());
  std::cout << corners_px.size() << " views, medians: corners " << median(corners_px) << " px, normal "
            << median(normals_deg) << " deg, height at 200 mm " << median(heights_mm)
            << " mm; mean normalised square " << mean << "\n";
  EXPECT_LT(median(corners_px), 0.04);
  EXPECT_LT(median(normals_deg), 0.05);
  EXPECT_LT(median(heights_mm), 0.2);
  EXPECT_GT(mean, 2.0);
  EXPECT_LT(mean, 10.0);
}

}  // namespace
}  // namespace traygauge
