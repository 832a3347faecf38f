// Photographs with known poses: matches obey the true epipolar geometry.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <span>

#include "core/geometry/geometry.hpp"
#include "core/paper/matching/matcher.hpp"
#include "tests/core/paper/sift_features.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge::paper {
namespace {

constexpr int kCap = 2500;

struct Photograph {
  Features features;
  Mat3 intrinsics;
  Pose camera_from_world;
};

Photograph load(const std::filesystem::path& folder, std::size_t index) {
  const auto cameras = nlohmann::json::parse(std::ifstream(folder / "cameras.json"));
  const nlohmann::json& view = cameras["views"][index];
  const std::string image = (folder / view["image"].get<std::string>()).string();
  Photograph photograph;
  photograph.features = sift_features(cv::imread(image, cv::IMREAD_GRAYSCALE), kCap);
  for (std::size_t i = 0; i < 9; ++i) {
    const auto row = static_cast<int>(i / 3);
    const auto column = static_cast<int>(i % 3);
    photograph.intrinsics(row, column) = view["K"][i].get<double>();
    photograph.camera_from_world.rotation(row, column) = view["R"][i].get<double>();
  }
  for (std::size_t i = 0; i < 3; ++i) {
    photograph.camera_from_world.translation(static_cast<int>(i)) = view["t"][i].get<double>();
  }
  return photograph;
}

// Share of matches within two pixels of the true epipolar line.
double true_fraction(const Photograph& first, const Photograph& second, std::span<const Match> matches) {
  const Mat3 rotation = second.camera_from_world.rotation * first.camera_from_world.rotation.transpose();
  const Pose motion{rotation,
                    second.camera_from_world.translation - rotation * first.camera_from_world.translation};
  const Mat3 fundamental =
      second.intrinsics.inverse().transpose() * essential_matrix(motion) * first.intrinsics.inverse();
  double good = 0.0;
  for (const Match& match : matches) {
    const Vec2& a = first.features.keypoints[static_cast<std::size_t>(match.first)].pixel;
    const Vec2& b = second.features.keypoints[static_cast<std::size_t>(match.second)].pixel;
    const Vec3 line = fundamental * a.homogeneous();
    good += std::abs(line.dot(b.homogeneous())) <= 2.0 * line.head<2>().norm() ? 1.0 : 0.0;
  }
  return good / static_cast<double>(matches.size());
}

TEST(RealPhotographs, FountainMatchesObeyTheTruePoses) {
  const char* captures = std::getenv("TRAYGAUGE_CAPTURES");
  if (captures == nullptr) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  const auto folder = std::filesystem::path(captures) / "real" / "strecha_fountain_P11";
  const Photograph first = load(folder, 4);
  const Photograph second = load(folder, 5);
  test::Allocated<MatcherWorkspace> memory(kCap);
  std::vector<Match> storage(2 * kCap);
  std::vector<double> shares;
  std::vector<std::size_t> counts;
  for (const MatcherParams& params : {MatcherParams{1, 1.0F}, MatcherParams{1, 1.1F}, MatcherParams{1, 1.2F},
                                      MatcherParams{2, 1.0F}, MatcherParams{1, 1.0F, 0.5F}}) {
    BoundedList<Match> matches(storage);
    match_features(first.features.view(), second.features.view(), params, *memory, matches);
    counts.push_back(matches.size());
    shares.push_back(true_fraction(first, second, matches.items()));
    std::cout << "k " << params.top_ranking << ", ratio " << params.distinctiveness_ratio << ", cutoff "
              << params.distance_cutoff << ": " << counts.back() << " matches, " << 100.0 * shares.back()
              << " % true\n";
  }
  EXPECT_GT(counts[1], 300U);
  EXPECT_GT(shares[1], 0.85);
  EXPECT_GE(shares[1], shares[0]) << "distinct matches are better";
  EXPECT_GE(shares[2], shares[1]);
  EXPECT_LT(shares[3], shares[0]) << "two ranks let worse matches in";
  EXPECT_GT(shares[4], shares[0]) << "near matches are better";
}

}  // namespace
}  // namespace traygauge::paper
