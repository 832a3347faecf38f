// SURF on an OpenCV picture, with memory that is sized as the estimator sizes it.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <opencv2/core.hpp>
#include <vector>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/paper/features/surf.hpp"
#include "core/paper/image/integral.hpp"

namespace traygauge::test {

constexpr std::size_t planned_bytes(int width, const paper::SurfParams& params) {
  ArenaPlan plan;
  paper::SurfWorkspace workspace;
  workspace.allocate(plan, width, params);
  return plan.high_water_bytes();
}

struct PictureFeatures {
  std::vector<paper::Keypoint> keypoints;
  std::vector<paper::Descriptor> descriptors;
  std::size_t dropped = 0;
};

class Integral {
 public:
  explicit Integral(const cv::Mat& gray)
      : sums_(static_cast<std::size_t>(gray.cols + 1) * static_cast<std::size_t>(gray.rows + 1)),
        view_(sums_.data(), gray.cols + 1, gray.rows + 1) {
    paper::build_integral({gray.data, gray.cols, gray.rows, static_cast<std::ptrdiff_t>(gray.step[0])},
                          view_);
  }
  ImageView<const std::uint32_t> view() const { return view_; }

 private:
  std::vector<std::uint32_t> sums_;
  ImageView<std::uint32_t> view_;
};

inline PictureFeatures run_surf(const cv::Mat& gray, const paper::SurfParams& params = {},
                                std::size_t cap = 20000) {
  struct alignas(kArenaAlignmentBytes) Line {
    std::byte bytes[kArenaAlignmentBytes];
  };
  const std::size_t bytes = planned_bytes(gray.cols, params);
  std::vector<Line> block(bytes / sizeof(Line));
  Arena arena({block.front().bytes, bytes});
  paper::SurfWorkspace workspace;
  workspace.allocate(arena, gray.cols, params);
  CV_Assert(!arena.exhausted());

  const Integral integral(gray);
  PictureFeatures features;
  features.keypoints.resize(cap);
  BoundedList<paper::Keypoint> list{std::span<paper::Keypoint>(features.keypoints)};
  paper::detect_surf(integral.view(), params, workspace, list);
  features.dropped = list.dropped();
  features.keypoints.resize(list.size());
  features.descriptors.resize(list.size());
  paper::describe_surf(integral.view(), features.keypoints, features.descriptors);
  return features;
}

}  // namespace traygauge::test
