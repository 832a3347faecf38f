// Pictures, rectification, dense matching, depth and volume.
#include <memory>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/paper/rectification/polar_rectification.hpp"
#include "core/paper/stereo/stereo.hpp"
#include "core/paper/surface/food_mesh.hpp"
#include "core/paper/volume/mesh_volume.hpp"
#include "tests/bench/comparisons.hpp"
#include "tests/bench/opencv_stereo.hpp"
#include "tests/bench/workspace.hpp"

namespace traygauge::bench {
namespace {

double pixels_of(const cv::Mat& mat) {
  return static_cast<double>(mat.total());
}

cv::Mat frame_mat(const Picture& frame) {
  return {frame.size.height, frame.size.width, frame.format == PixelFormat::gray8 ? CV_8U : CV_8UC3,
          const_cast<std::uint8_t*>(frame.pixels.data())};
}

// The frame, undistorted and with the dish at its working size. The peer takes one sample a pixel, ours as
// many as the reduction asks for; with `maps` given the peer does not work out where the pixels come from.
Comparison compare_resampling(const StageData& data) {
  const Roi& cutout = data.cutouts[0];
  const auto ours = [&data, &cutout, gray = cv::Mat(cutout.height, cutout.width, CV_8U)]() mutable {
    resample_undistorted(data.frames[0]->frame(), data.scene.lens, cutout, target_of(gray));
    return pixels_of(gray);
  };
  const auto make_maps = [lens = OpenCvLens(data.scene.lens), camera = test::camera_matrix(cutout.camera),
                          size = cv::Size(cutout.width, cutout.height)](cv::Mat& first, cv::Mat& second) {
    cv::initUndistortRectifyMap(lens.camera, lens.distortion, cv::noArray(), camera, size, CV_16SC2, first,
                                second);
  };
  const auto remap = [frame = frame_mat(*data.frames[0])](const cv::Mat& first, const cv::Mat& second) {
    cv::Mat sampled;
    cv::remap(frame, sampled, first, second, cv::INTER_LINEAR);
    if (sampled.channels() == 3) cv::cvtColor(sampled, sampled, cv::COLOR_RGB2GRAY);
    return pixels_of(sampled);
  };
  cv::Mat columns;
  cv::Mat rows;
  make_maps(columns, rows);
  return {"resampling",
          "pixels",
          {{"ours", ours},
           {"cv maps + cv::remap",
            [make_maps, remap] {
              cv::Mat first;
              cv::Mat second;
              make_maps(first, second);
              return remap(first, second);
            }},
           {"cv::remap alone", [remap, columns, rows] { return remap(columns, rows); }}}};
}

Comparison compare_reduction(const StageData& data) {
  const cv::Size size = data.features[0].picture.size();
  const auto ours = [&data, target = cv::Mat(size, CV_8U)]() mutable {
    reduce_area(view_of(data.gray[0]), target_of(target));
    return pixels_of(target);
  };
  const auto peer = [&data, size] {
    cv::Mat target;
    cv::resize(data.gray[0], target, size, 0.0, 0.0, cv::INTER_AREA);
    return pixels_of(target);
  };
  return {"reduction", "pixels", {{"ours", ours}, {"cv::resize, INTER_AREA", peer}}};
}

Method our_rectification(const StageData& data) {
  const paper::RectificationParams& params = data.session.configuration.rectification;
  const auto workspace = std::make_shared<OwnedWorkspace<paper::RectificationWorkspace>>(params);
  std::array<cv::Mat, 2> gray{data.rectified[0].clone(), data.rectified[1].clone()};
  std::array<cv::Mat, 2> regions{data.rectified_regions[0].clone(), data.rectified_regions[1].clone()};
  return {"ours, polar", [&data, &params, workspace, gray, regions]() mutable {
            paper::PolarRectification rectification;
            const Status status =
                rectification.build({data.cutouts[0].camera, view_of(data.regions[0])},
                                    {data.cutouts[1].camera, view_of(data.regions[1])},
                                    data.other_from_reference, data.inliers, params, **workspace);
            if (!status.ok()) return 0.0;
            for (std::size_t i = 0; i < 2; ++i) {
              const int view = static_cast<int>(i);
              rectification.rectify(view, view_of(data.working[i]), target_of(gray[i]));
              rectification.rectify_labels(view, view_of(data.regions[i]), target_of(regions[i]));
            }
            return pixels_of(gray[0]);
          }};
}

// Planar: x along the baseline, pictures of the same size as ours.
Comparison compare_rectification(const StageData& data) {
  const auto peer = [&data, rotation = rotation_matrix(data.other_from_reference.rotation),
                     translation = vector_of(data.other_from_reference.translation)] {
    const std::array cameras{cv::Mat(test::camera_matrix(data.cutouts[0].camera)),
                             cv::Mat(test::camera_matrix(data.cutouts[1].camera))};
    std::array<cv::Mat, 2> turns;
    std::array<cv::Mat, 2> projections;
    cv::Mat disparity_to_depth;
    cv::stereoRectify(cameras[0], cv::noArray(), cameras[1], cv::noArray(), data.working[0].size(), rotation,
                      translation, turns[0], turns[1], projections[0], projections[1], disparity_to_depth, 0,
                      -1.0, data.rectified[0].size());
    double pixels = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
      cv::Mat columns;
      cv::Mat rows;
      cv::Mat gray;
      cv::Mat region;
      cv::initUndistortRectifyMap(cameras[i], cv::noArray(), turns[i], projections[i],
                                  data.rectified[i].size(), CV_16SC2, columns, rows);
      cv::remap(data.working[i], gray, columns, rows, cv::INTER_LINEAR);
      cv::remap(data.regions[i], region, columns, rows, cv::INTER_NEAREST);
      if (i == 0) pixels = pixels_of(gray);
    }
    return pixels;
  };
  return {"rectification", "pixels", {our_rectification(data), {"cv::stereoRectify + remap", peer}}};
}

Method our_stereo(const StageData& data) {
  const paper::Configuration& configuration = data.session.configuration;
  const auto workspace = std::make_shared<OwnedWorkspace<paper::StereoWorkspace>>(
      configuration.rectification.max_columns, configuration.rectification.max_rows,
      configuration.disparity_range.max_count, configuration.stereo);
  const DisparityRange range = data.measurement.report.disparity_range;
  return {"ours", [&data, &configuration, workspace, range,
                   disparity = cv::Mat(data.rectified[0].size(), CV_16S)]() mutable {
            const Status status =
                paper::match_dense(view_of(data.rectified[0]), view_of(data.rectified_regions[0]),
                                   view_of(data.rectified[1]), view_of(data.rectified_regions[1]), range,
                                   configuration.stereo, **workspace, target_of<Disparity>(disparity));
            if (!status.ok()) return 0.0;
            return 100.0 * cv::countNonZero(disparity != kNoDisparity) /
                   cv::countNonZero(data.rectified_regions[0]);
          }};
}

// OpenCV counts disparities the other way and in multiples of sixteen; both pictures get one width.
Method opencv_stereo(const std::string& name, const StageData& data, int mode) {
  const DisparityRange range = data.measurement.report.disparity_range;
  const int count = (range.count() + 15) / 16 * 16;
  const int width = std::max(data.rectified[0].cols, data.rectified[1].cols);
  std::array<cv::Mat, 2> pictures;
  for (std::size_t i = 0; i < 2; ++i) {
    cv::copyMakeBorder(data.rectified[i], pictures[i], 0, 0, 0, width - data.rectified[i].cols,
                       cv::BORDER_CONSTANT);
  }
  cv::Mat region = cv::Mat::zeros(data.rectified[0].rows, width, CV_8U);
  data.rectified_regions[0].copyTo(region.colRange(0, data.rectified[0].cols));
  const cv::Ptr<cv::StereoSGBM> matcher =
      cv::StereoSGBM::create(-range.max_px, count, 5, 8 * 25, 64 * 25, 1, 0, 5, 0, 0, mode);
  return {name, [pictures, region, matcher, least = -range.max_px * cv::StereoMatcher::DISP_SCALE] {
            cv::Mat disparity;
            matcher->compute(pictures[0], pictures[1], disparity);
            return 100.0 * cv::countNonZero((disparity >= least) & region) / cv::countNonZero(region);
          }};
}

Comparison compare_stereo(const StageData& data) {
  return {"stereo",
          "% of the dish",
          {our_stereo(data), opencv_stereo("cv::StereoSGBM, 3-way", data, cv::StereoSGBM::MODE_SGBM_3WAY),
           opencv_stereo("cv::StereoSGBM, 5 paths", data, cv::StereoSGBM::MODE_SGBM)}};
}

// The peer triangulates the same points one by one and integrates the triangles of one label.
double volume_by_subdivision(const paper::FoodMesh& mesh, const PinholeCamera& camera, const Plane& bottom,
                             cv::Size size) {
  cv::Subdiv2D subdivision(cv::Rect(cv::Point(), size));
  std::vector<int> point_of(4 + mesh.points.size() + 4, -1);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vec3& position = mesh.points[i].position_mm;
    const Vec2 pixel = camera.pixel(position.head<2>() / position.z());
    const int vertex =
        subdivision.insert(cv::Point2f(static_cast<float>(pixel.x()), static_cast<float>(pixel.y())));
    point_of[static_cast<std::size_t>(vertex)] = static_cast<int>(i);
  }
  std::vector<int> edges;
  subdivision.getLeadingEdgeList(edges);
  double volume_mm3 = 0.0;
  for (const int edge : edges) {
    std::array<const paper::MeshPoint*, 3> corners{};
    int side = edge;
    for (auto& corner : corners) {
      const int point = point_of[static_cast<std::size_t>(subdivision.edgeOrg(side))];
      if (point >= 0) corner = &mesh.points[static_cast<std::size_t>(point)];
      side = subdivision.getEdge(side, cv::Subdiv2D::NEXT_AROUND_LEFT);
    }
    if (!corners[0] || !corners[1] || !corners[2]) continue;
    if (corners[0]->label != corners[1]->label || corners[0]->label != corners[2]->label) continue;
    const Vec3& a = corners[0]->position_mm;
    const Vec3& b = corners[1]->position_mm;
    const Vec3& c = corners[2]->position_mm;
    volume_mm3 += 0.5 * bottom.normal.dot((b - a).cross(c - a)) * bottom.height((a + b + c) / 3.0);
  }
  return std::abs(volume_mm3) / 1000.0;
}

Comparison compare_volume(const StageData& data) {
  const paper::Configuration& configuration = data.session.configuration;
  const auto points = static_cast<std::size_t>(configuration.mesh.points);
  const cv::Size size = data.working[0].size();
  const auto mesh_workspace = std::make_shared<OwnedWorkspace<paper::FoodMeshWorkspace>>(
      points, static_cast<std::size_t>(size.width), static_cast<std::size_t>(size.height));
  const auto volume_workspace = std::make_shared<OwnedWorkspace<paper::VolumeWorkspace>>(points);
  const MeasurementViews& views = data.measurement.views;
  const paper::WorkingPictures& pictures = data.session.estimator.pictures();
  const auto ours = [&data, &configuration, &views, &pictures, mesh_workspace, volume_workspace] {
    paper::FoodMesh mesh;
    Status status =
        paper::build_food_mesh(pictures.depth_mm, view_of(data.working_labels[0]), data.cutouts[0].camera,
                               configuration.mesh, **mesh_workspace, mesh);
    if (!status.ok()) return 0.0;
    status = paper::integrate_volume(mesh, views.dish_bottom, configuration.volume, **volume_workspace);
    if (!status.ok()) return 0.0;
    double total_ml = 0.0;
    for (const paper::ItemVolume& item : (**volume_workspace).items) total_ml += item.volume_ml;
    return total_ml;
  };
  const auto peer = [&data, &views, &pictures, size] {
    return volume_by_subdivision(pictures.mesh, data.cutouts[0].camera, views.dish_bottom, size);
  };
  return {"mesh, volume", "ml", {{"ours", ours}, {"cv::Subdiv2D, its triangles", peer}}};
}

}  // namespace

std::vector<Comparison> compare_dense_stages(const StageData& data) {
  return {compare_reduction(data), compare_resampling(data), compare_rectification(data),
          compare_stereo(data), compare_volume(data)};
}

}  // namespace traygauge::bench
