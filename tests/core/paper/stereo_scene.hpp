// Pairs of pictures and a matcher with memory, for the tests of dense matching.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <new>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/base/arena.hpp"
#include "core/paper/stereo/stereo.hpp"
#include "tests/support/pictures.hpp"

namespace traygauge::test {

// A rectified pair; masks are everywhere set unless a test says otherwise.
struct TestPair {
  cv::Mat_<std::uint8_t> first, first_mask, second, second_mask;

  TestPair() = default;
  TestPair(cv::Mat_<std::uint8_t> first_, cv::Mat_<std::uint8_t> second_)
      : first(first_), first_mask(first_.size(), 255), second(second_), second_mask(second_.size(), 255) {}
};

// Memory for one workspace, by its own plan.
class Matcher {
 public:
  Matcher(int columns, int rows, int disparities, const paper::StereoParams& params) : params_(params) {
    ArenaPlan plan;
    paper::StereoWorkspace planned;
    planned.allocate(plan, columns, rows, disparities, params);
    bytes_ = plan.high_water_bytes();
    block_.reset(static_cast<std::byte*>(::operator new (bytes_, std::align_val_t{kArenaAlignmentBytes})));
    Arena arena({block_.get(), bytes_});
    workspace_.allocate(arena, columns, rows, disparities, params);
    EXPECT_FALSE(arena.exhausted());
  }

  Status match(const TestPair& pair, DisparityRange range, cv::Mat_<Disparity>& disparity) {
    disparity.create(pair.first.size());
    return paper::match_dense(view_of(pair.first), view_of(pair.first_mask), view_of(pair.second),
                              view_of(pair.second_mask), range, params_, workspace_, view_of(disparity));
  }
  std::size_t bytes() const { return bytes_; }

 private:
  struct Free {
    void operator()(std::byte* block) const {
      ::operator delete (block, std::align_val_t{kArenaAlignmentBytes});
    }
  };
  paper::StereoParams params_;
  paper::StereoWorkspace workspace_;
  std::unique_ptr<std::byte, Free> block_;
  std::size_t bytes_ = 0;
};

// Matches with a workspace of just the size.
inline cv::Mat_<Disparity> match(const TestPair& pair, DisparityRange range,
                                 const paper::StereoParams& params = {}) {
  Matcher matcher(std::max(pair.first.cols, pair.second.cols), pair.first.rows, range.count(), params);
  cv::Mat_<Disparity> disparity;
  EXPECT_TRUE(matcher.match(pair, range, disparity).ok());
  return disparity;
}

// Smooth noise with detail of a few pixels, as food has.
inline cv::Mat_<std::uint8_t> random_texture(int width, int height, std::uint64_t seed) {
  cv::RNG rng(seed);
  cv::Mat fine(height, width, CV_32F);
  cv::Mat coarse(height, width, CV_32F);
  rng.fill(fine, cv::RNG::UNIFORM, -1.0, 1.0);
  rng.fill(coarse, cv::RNG::UNIFORM, -1.0, 1.0);
  cv::GaussianBlur(fine, fine, {}, 1.0);
  cv::GaussianBlur(coarse, coarse, {}, 4.0);
  cv::Mat_<std::uint8_t> texture;
  cv::Mat(128.0 + 110.0 * fine + 300.0 * coarse).convertTo(texture, CV_8U);
  return texture;
}

}  // namespace traygauge::test
