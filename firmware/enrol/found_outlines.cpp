#include "firmware/enrol/found_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/dish/rim_tracer.hpp"
#include "core/labels/convex_fill.hpp"
#include "firmware/base/aligned_block.hpp"
#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/measure/capture_session.hpp"
#include "firmware/measure/missing_card.hpp"
#include "simulator/capture/picture_file.hpp"

namespace traygauge {
namespace {

constexpr double kLeastSideMm = 50.0;
constexpr double kLargestSideMm = 600.0;
constexpr double kLeastRimMm = 3.0;
constexpr double kHighestRimMm = 150.0;  // as DishEdgeParams::highest_mm
// How far from where it is expected the edge is looked for, pass by pass: a ruler is right to some
// millimetres.
constexpr std::array<double, 4> kReachMm{4.0, 2.5, 2.5, 1.5};
constexpr int kMinPoints = 24;
constexpr double kStrayFactor = 3.0;   // times the median distance: such points are no part of the rim
constexpr double kLeastStrayMm = 0.5;  // two pixels of the edge
// Of the rim; below, several edges run around the dish. Plain glaze on a plain table has all of it, a
// patterned dish on a patterned table 0.77.
constexpr double kLeastOnEllipse = 0.6;

DishDescription describe(const RuledDish& ruled) {
  DishDescription dish;
  dish.style = "found";
  dish.outer_size_mm = ruled.outer_size_mm;
  dish.rim_height_mm = ruled.rim_height_mm;
  dish.bottom_height_mm = 0.0;
  return dish;
}

void require_found(const Capture& capture, const CaptureSession& session) {
  const Segmentation& found = session.drawn()->segmentation;
  if (found.dish_count == 0) {
    const StatusCode status = found.status.code();
    throw InputError({capture.file, ""}, "a dish and the card in both views",
                     sentence(status) + explain_missing_card(status, session), "take both pictures again");
  }
  const Status status = found.dishes.front().status;
  if (!status.ok()) {
    throw InputError({capture.file, ""}, "an empty dish of that size", sentence(status.code()),
                     "measure length, width and rim with a ruler, and take both pictures again");
  }
}

// On the level of the rim.
std::vector<cv::Point2f> lay_on_level(std::span<const Vec2> rays, const Pose& camera_from_table,
                                      double height_mm) {
  const Pose table_from_camera = camera_from_table.inverse();
  std::vector<cv::Point2f> points;
  points.reserve(rays.size());
  for (const Vec2& ray : rays) {
    const Vec3 along = table_from_camera.rotation * ray.homogeneous();
    const Vec3& centre = table_from_camera.translation;
    const Vec3 point = centre + (height_mm - centre.z()) / along.z() * along;
    points.emplace_back(static_cast<float>(point.x()), static_cast<float>(point.y()));
  }
  return points;
}

// Roughly, near the ellipse.
double distance_mm(const cv::RotatedRect& ellipse, const cv::Point2f& point) {
  const double angle = ellipse.angle * std::numbers::pi / 180.0;
  const cv::Point2f off = point - ellipse.center;
  const double u = (off.x * std::cos(angle) + off.y * std::sin(angle)) / (0.5 * ellipse.size.width);
  const double v = (off.y * std::cos(angle) - off.x * std::sin(angle)) / (0.5 * ellipse.size.height);
  const double radius = std::hypot(u, v);
  return std::abs(1.0 - 1.0 / std::max(radius, 0.01)) * cv::norm(off);
}

// The rim of a dish in one view, as an ellipse on its level.
class RimFit {
 public:
  RimFit(const DishSearchViews& views, std::size_t view, const SegmentedDish& dish,
         DishSearchWorkspace& workspace)
      : views_(views),
        view_(view),
        inside_sign_(dish.found.inside_sign),
        workspace_(workspace),
        place_(dish.found.place) {}

  // False where no one ellipse goes through what shows around the dish.
  bool fit() {
    for (const double reach_mm : kReachMm) {
      std::vector<cv::Point2f> points = edge_points(reach_mm);
      if (points.size() < kMinPoints || !fit_ellipse(points)) return false;
    }
    return on_ellipse_ >= kLeastOnEllipse * params_.outline_points;
  }
  const DishPose& place() const { return place_; }

 private:
  std::vector<cv::Point2f> edge_points(double reach_mm) {
    DishSearchParams params = params_;
    params.edge_reach_mm = reach_mm;
    RimTracer tracer(views_, params, workspace_);
    tracer.trace(view_, place_, inside_sign_, params.min_step, RimChoice::nearest,
                 workspace_.outlines[view_]);
    return lay_on_level(workspace_.outlines[view_].items(), views_[view_].camera_from_table,
                        place_.edge_height_mm);
  }
  // Once through all points, then through those that are near.
  bool fit_ellipse(std::vector<cv::Point2f>& points) {
    cv::RotatedRect ellipse;
    for (int round = 0; round < 3; ++round) {
      ellipse = cv::fitEllipseDirect(points);
      std::vector<double> distances;
      distances.reserve(points.size());
      for (const cv::Point2f& point : points) distances.push_back(distance_mm(ellipse, point));
      std::vector<double> sorted = distances;
      std::ranges::nth_element(sorted, sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2));
      const double most = std::max(kLeastStrayMm, kStrayFactor * sorted[sorted.size() / 2]);
      std::size_t kept = 0;
      for (std::size_t i = 0; i < distances.size(); ++i)
        if (distances[i] <= most) points[kept++] = points[i];
      points.resize(kept);
      if (kept < kMinPoints) return false;
    }
    on_ellipse_ = static_cast<double>(points.size());
    place_.centre_mm = {ellipse.center.x, ellipse.center.y};
    place_.size_mm = {ellipse.size.width, ellipse.size.height};
    place_.azimuth_rad = ellipse.angle * std::numbers::pi / 180.0;
    return ellipse.size.width > kLeastSideMm && ellipse.size.height > kLeastSideMm;
  }

  const DishSearchViews& views_;
  std::size_t view_;
  int inside_sign_;
  DishSearchWorkspace& workspace_;
  DishSearchParams params_;
  DishPose place_;
  double on_ellipse_ = 0.0;
};

// The card as it was found, and the dish.
Picture draw_outline(const Picture& found, const DishSearchView& view, const DishPose& place) {
  Picture labels = found;
  std::ranges::replace_if(
      labels.pixels, [](std::uint8_t label) { return label != kCardLabel; }, kBackgroundLabel);
  fill_convex({labels.pixels.data(), labels.size.width, labels.size.height},
              rim_outline(place, view, 0.0, 0.0), kDishLabel);
  return labels;
}

}  // namespace

RuledDish read_ruled_dish(const std::string& text) {
  const std::vector<double> numbers_mm = read_sizes(text);
  const auto is_side = [](double mm) { return mm >= kLeastSideMm && mm <= kLargestSideMm; };
  if (numbers_mm.size() != 3 || !is_side(numbers_mm[0]) || !is_side(numbers_mm[1]) ||
      !(numbers_mm[2] >= kLeastRimMm && numbers_mm[2] <= kHighestRimMm)) {
    throw UsageError(
        "--size: expected length, width and height of the rim in mm, such as 262x262x23, found " +
        printable(text));
  }
  return {{std::max(numbers_mm[0], numbers_mm[1]), std::min(numbers_mm[0], numbers_mm[1])}, numbers_mm[2]};
}

std::array<Picture, 2> find_dish_outlines(const Capture& capture, std::array<int, 2> pair,
                                          const RuledDish& ruled) {
  const CaptureSession session(capture, pair, {describe(ruled)}, {}, LabelSource::automatic);
  require_found(capture, session);
  const Segmentation& found = session.drawn()->segmentation;
  std::array<Picture, 2> grays;
  DishSearchViews views;
  for (std::size_t v = 0; v < 2; ++v) {
    grays[v] = to_gray(session.view(static_cast<int>(v)).picture);
    views[v] = {grays[v].frame(), session.lens(static_cast<int>(v)), found.cards[v].camera_from_table};
  }
  const DishSearchParams params;
  ArenaPlan plan;
  DishSearchWorkspace workspace;
  workspace.allocate(plan, params);
  const AlignedBlock block(plan.high_water_bytes());
  Arena arena(block.bytes());
  workspace.allocate(arena, params);
  std::array<Picture, 2> outlines;
  for (std::size_t v = 0; v < 2; ++v) {
    RimFit rim(views, v, found.dishes.front(), workspace);
    if (!rim.fit()) {
      throw InputError(
          {capture.file, ""}, "one clear edge around the dish", "several, or none",
          "measure length, width and rim to 2 mm; lay the dish on a table of another colour, without shade "
          "beside it; or outline it by hand");
    }
    outlines[v] = draw_outline(session.drawn()->labels[v], views[v], rim.place());
  }
  return outlines;
}

}  // namespace traygauge
