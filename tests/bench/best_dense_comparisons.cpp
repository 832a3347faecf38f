// Profile `best`: sampling over the dish, dense matching and the surface of both views.
#include <memory>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/stereo/sgm.hpp"
#include "core/stereo/symmetric_census.hpp"
#include "tests/bench/comparisons.hpp"
#include "tests/bench/opencv_stereo.hpp"

namespace traygauge::bench {
namespace {

// Where the samples lie in either view, as cv::remap wants it.
std::array<cv::Mat, 2> sample_maps(const BestData& data, const PlaneRectification& grid) {
  std::array<cv::Mat, 2> maps;
  for (std::size_t i = 0; i < 2; ++i) {
    maps[i].create(grid.rows(), grid.columns(), CV_32FC2);
    for (int row = 0; row < grid.rows(); ++row) {
      for (int column = 0; column < grid.columns(); ++column) {
        const Vec3 seen = data.views[i].camera_from_table * grid.plane_point(row, column);
        const Vec2 pixel = data.scene.lens.pixel(seen.hnormalized());
        maps[i].at<cv::Vec2f>(row, column) = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
      }
    }
  }
  return maps;
}

// Ours works out where the samples lie, and averages where it reduces; the peer does neither.
Comparison compare_sampling(const BestData& data) {
  const PlaneRectificationParams& params = data.configuration.surface.rectification;
  const LabelTable kept = labels_on_dish(labels_of_single_dish());
  const double bottom_mm = data.scene.dish.bottom_height_mm;
  const cv::Mat& like = data.views[0].sampled;
  const auto rows = std::make_shared<std::vector<PlaneRow>>(static_cast<std::size_t>(params.max_rows));
  const auto ours = [&data, &params, kept, bottom_mm, rows, gray = like.clone(),
                     labels = like.clone()]() mutable {
    PlaneRectification grid;
    const std::array<StoredView, 2> views = data.stored();
    if (!grid.build(views, kept, bottom_mm, params, *rows).ok()) return 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
      grid.sample_gray(views[i], target_of(gray));
      grid.sample_labels(views[i], kept, target_of(labels));
    }
    return static_cast<double>(gray.total());
  };
  PlaneRectification grid;
  std::array<cv::Mat, 2> maps;
  if (grid.build(data.stored(), kept, bottom_mm, params, *rows).ok()) maps = sample_maps(data, grid);
  const auto peer = [&data, maps] {
    cv::Mat gray;
    cv::Mat labels;
    for (std::size_t i = 0; i < 2; ++i) {
      cv::remap(data.views[i].gray, gray, maps[i], cv::noArray(), cv::INTER_LINEAR);
      cv::remap(data.views[i].labels, labels, maps[i], cv::noArray(), cv::INTER_NEAREST);
    }
    return static_cast<double>(gray.total());
  };
  return {"sampling", "pixels", {{"ours, over the dish's bottom", ours}, {"cv::remap alone", peer}}};
}

double percent_matched(const cv::Mat& is_matched, const cv::Mat& labels) {
  return 100.0 * cv::countNonZero(is_matched & (labels != 0)) / cv::countNonZero(labels);
}

// One view against the other over the whole range, without coarser levels; the census included.
Method our_semi_global(const BestData& data) {
  const cv::Mat& like = data.views[0].sampled;
  const int lanes = std::min((data.range.count() + kBandLanes - 1) / kBandLanes * kBandLanes, kMaxBandLanes);
  const auto workspace =
      std::make_shared<OwnedWorkspace<SgmWorkspace>>(like.cols, static_cast<int>(like.total()) * lanes);
  const cv::Mat first(like.size(), CV_16S, cv::Scalar(data.range.min_px));
  return {"ours, census, 4 paths",
          [&data, workspace, first, lanes, disparity = cv::Mat(like.size(), CV_16S),
           codes = std::array<std::vector<std::uint32_t>, 2>{std::vector<std::uint32_t>(like.total()),
                                                             std::vector<std::uint32_t>(like.total())},
           mask = std::vector<std::uint32_t>(like.total())]() mutable {
            const cv::Size size = disparity.size();
            BandedPair pair;
            for (std::size_t i = 0; i < 2; ++i) {
              const ImageView<std::uint32_t> target(codes[i].data(), size.width, size.height);
              transform_symmetric_census(view_of(data.views[i].sampled), target);
              pair.gray[i] = view_of(data.views[i].sampled);
              pair.labels[i] = view_of(data.views[i].sampled_labels);
              pair.codes[i] = target;
            }
            const ImageView<std::uint32_t> masks(mask.data(), size.width, size.height);
            mask_symmetric_census(pair.labels[0], masks);
            pair.mask = masks;
            match_sgm(pair, view_of<std::int16_t>(first), lanes, data.configuration.surface.sgm, **workspace,
                      target_of<Disparity>(disparity));
            return percent_matched(disparity != kNoDisparity, data.views[0].sampled_labels);
          }};
}

cv::Ptr<cv::StereoSGBM> make_matcher(const BestData& data, bool from_other, int mode) {
  // OpenCV counts disparities the other way and in multiples of sixteen.
  const int least = from_other ? data.range.min_px : -data.range.max_px;
  const int count = (data.range.count() + 15) / 16 * 16;
  return cv::StereoSGBM::create(least, count, 5, 8 * 25, 64 * 25, 1, 0, 5, 0, 0, mode);
}

double match_by_opencv(const BestData& data, std::size_t reference, cv::StereoSGBM& matcher,
                       cv::Mat& disparity) {
  const BestDataView& view = data.views[reference];
  matcher.compute(view.sampled, data.views[1 - reference].sampled, disparity);
  const int least = matcher.getMinDisparity() * cv::StereoMatcher::DISP_SCALE;
  return percent_matched(disparity >= least, view.sampled_labels);
}

Method opencv_semi_global(const std::string& name, const BestData& data, int mode) {
  return {name, [&data, matcher = make_matcher(data, false, mode)] {
            cv::Mat disparity;
            return match_by_opencv(data, 0, *matcher, disparity);
          }};
}

Comparison compare_semi_global(const BestData& data) {
  return {"semi-global",
          "% of the dish",
          {our_semi_global(data),
           opencv_semi_global("cv::StereoSGBM, 3-way", data, cv::StereoSGBM::MODE_SGBM_3WAY),
           opencv_semi_global("cv::StereoSGBM, 4 paths (HH4)", data, cv::StereoSGBM::MODE_HH4)}};
}

// Ours samples, matches coarse to fine, refines below the pixel, checks and triangulates; the peer matches
// the samples with either view as the reference and filters.
Comparison compare_surface(const BestData& data) {
  const DenseStereoParams& params = data.configuration.surface;
  const auto ours = [&data, &params,
                     workspace = std::make_shared<OwnedWorkspace<DenseStereoWorkspace>>(params)] {
    std::array<SurfaceGrid, 2> grids;
    DenseStereoReport report;
    const Status status =
        run_dense_stereo(data.stored(), labels_on_dish(labels_of_single_dish()),
                         data.scene.dish.bottom_height_mm, data.top_mm, params, **workspace, grids, report);
    return status.ok() ? 50.0 * (report.confirmed[0] + report.confirmed[1]) : 0.0;
  };
  const auto peer = [&data, matchers = std::array{make_matcher(data, false, cv::StereoSGBM::MODE_SGBM_3WAY),
                                                  make_matcher(data, true, cv::StereoSGBM::MODE_SGBM_3WAY)}] {
    double percent = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
      cv::Mat disparity;
      percent += 0.5 * match_by_opencv(data, i, *matchers[i], disparity);
      cv::medianBlur(disparity, disparity, 5);
    }
    return percent;
  };
  return {"surface",
          "% of the dish",
          {{"ours, both views to points", ours}, {"cv::StereoSGBM, both ways", peer}}};
}

}  // namespace

std::vector<Comparison> compare_best_dense_stages(const BestData& data) {
  return {compare_sampling(data), compare_semi_global(data), compare_surface(data)};
}

}  // namespace traygauge::bench
