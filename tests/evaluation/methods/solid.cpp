#include "tests/evaluation/methods/solid.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core/optim.hpp>
#include <opencv2/imgproc.hpp>

namespace traygauge::tables {
namespace {

constexpr int kOutlineSteps = 48;
constexpr int kRings = 6;
constexpr int kMaxSide = 160;  // of the mask while fitting
constexpr int kMargin = 12;    // around it: a silhouette that is too large costs, too
constexpr int kFixedPointBits = 4;
constexpr int kMaxEvaluations = 600;
constexpr double kMinSize_mm = 3.0;

Vec2 direction(const Solid& solid, double angle) {
  const Vec2 local(solid.half_axes_mm.x() * std::cos(angle), solid.half_axes_mm.y() * std::sin(angle));
  return Eigen::Rotation2Dd(solid.azimuth_rad) * local;
}

// Radius of a horizontal section over that of the footprint, at a share of the height.
double section(Template shape, double share) {
  switch (shape) {
    case Template::cap:
      return std::sqrt(1.0 - share);
    case Template::half_ellipsoid:
      return std::sqrt(1.0 - share * share);
    default:
      return 1.0;
  }
}

// The mask, cut out and reduced, and the cost of a solid.
class OverlapCost final : public cv::MinProblemSolver::Function {
 public:
  OverlapCost(const ItemView& view, Template shape, const std::function<double(double)>& height_mm)
      : view_(view), shape_(shape), height_mm_(height_mm) {
    cv::Rect box = cv::boundingRect(view.mask);
    origin_ = {box.x - kMargin, box.y - kMargin};
    box += cv::Size(2 * kMargin, 2 * kMargin);
    scale_ = std::min(1.0, static_cast<double>(kMaxSide) / std::max(box.width, box.height));
    cv::Mat cut;
    cv::copyMakeBorder(view.mask, cut, kMargin, kMargin, kMargin, kMargin, cv::BORDER_CONSTANT, 0);
    cut = cut({origin_.x + kMargin, origin_.y + kMargin, box.width, box.height}) != 0;
    cv::resize(cut, mask_, {}, scale_, scale_, cv::INTER_AREA);
    mask_ = mask_ >= 128;
    mask_area_ = cv::countNonZero(mask_);
  }

  int getDims() const override { return 5; }
  double calc(const double* x) const override { return 1.0 - overlap(solid(x)); }

  // Centre, logarithms of the half axes, azimuth.
  Solid solid(const double* x) const {
    Solid own{shape_, {x[0], x[1]}, {std::exp(x[2]), std::exp(x[3])}, x[4]};
    own.height_mm = height_mm_(footprint_mm2(own));
    return own;
  }

  double overlap(const Solid& solid) const {
    std::vector<cv::Point2f> pixels;
    for (const Vec3& point : silhouette_points(solid)) {
      const Vec3 seen = view_.camera_from_dish * point;
      if (seen.z() <= 0.0) return 0.0;
      const Vec2 pixel = view_.camera.pixel(seen.hnormalized());
      pixels.emplace_back(static_cast<float>((pixel.x() - origin_.x) * scale_),
                          static_cast<float>((pixel.y() - origin_.y) * scale_));
    }
    std::vector<cv::Point2f> hull;
    cv::convexHull(pixels, hull);
    constexpr float kFixedPoint = 1 << kFixedPointBits;
    std::vector<cv::Point> polygon;
    for (const cv::Point2f& corner : hull) polygon.emplace_back(corner * kFixedPoint);
    cv::Mat drawn = cv::Mat::zeros(mask_.size(), CV_8UC1);
    cv::fillConvexPoly(drawn, polygon, 255, cv::LINE_8, kFixedPointBits);
    // What lies outside the cut counts to the union, too.
    const double area = std::max<double>(cv::contourArea(hull), cv::countNonZero(drawn));
    const double common = cv::countNonZero(drawn & mask_);
    return common / (area + mask_area_ - common);
  }

 private:
  const ItemView& view_;
  Template shape_;
  const std::function<double(double)>& height_mm_;
  cv::Point origin_;
  double scale_ = 1.0;
  cv::Mat mask_;
  int mask_area_ = 0;
};

// By the moments of the mask, seen on a plane somewhat above the bottom.
std::array<double, 5> start_of(const ItemView& view) {
  std::vector<cv::Point> pixels;
  cv::findNonZero(view.mask, pixels);
  const auto moments = [&](double height_mm, Vec2& mean, Eigen::Matrix2d& covariance) {
    mean.setZero();
    covariance.setZero();
    for (const cv::Point& pixel : pixels)
      mean += sight_at_height(view, Vec2(pixel.x, pixel.y), height_mm).head<2>();
    mean /= static_cast<double>(pixels.size());
    for (const cv::Point& pixel : pixels) {
      const Vec2 d = sight_at_height(view, Vec2(pixel.x, pixel.y), height_mm).head<2>() - mean;
      covariance += d * d.transpose();
    }
    covariance /= static_cast<double>(pixels.size());
  };
  constexpr double kUsualHeight_mm = 10.0;
  Vec2 mean;
  Eigen::Matrix2d covariance;
  moments(kUsualHeight_mm, mean, covariance);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance);
  // The variance along an axis of an ellipse is a quarter of the half axis squared.
  const auto half_axis = [&](int i) { return std::max(kMinSize_mm, 2.0 * std::sqrt(axes.eigenvalues()[i])); };
  const Vec2 first = axes.eigenvectors().col(1);
  return {mean.x(), mean.y(), std::log(half_axis(1)), std::log(half_axis(0)),
          std::atan2(first.y(), first.x())};
}

}  // namespace

double footprint_mm2(const Solid& solid) {
  const double product = solid.half_axes_mm.x() * solid.half_axes_mm.y();
  return (solid.shape == Template::box ? 4.0 : std::numbers::pi) * product;
}

double volume_ml(const Solid& solid) {
  const double prism_ml = 1e-3 * footprint_mm2(solid) * solid.height_mm;
  if (solid.shape == Template::cap) return prism_ml / 2.0;
  return solid.shape == Template::half_ellipsoid ? prism_ml * 2.0 / 3.0 : prism_ml;
}

double relative_height(const Solid& solid, const Vec2& place_mm) {
  const Vec2 local = (Eigen::Rotation2Dd(-solid.azimuth_rad) * (place_mm - solid.centre_mm))
                         .cwiseQuotient(solid.half_axes_mm);
  if (solid.shape == Template::box) return local.cwiseAbs().maxCoeff() <= 1.0 ? 1.0 : 0.0;
  const double u = local.squaredNorm();
  if (u > 1.0) return 0.0;
  if (solid.shape == Template::cap) return 1.0 - u;
  return solid.shape == Template::half_ellipsoid ? std::sqrt(1.0 - u) : 1.0;
}

std::vector<Vec3> silhouette_points(const Solid& solid) {
  std::vector<Vec3> points;
  if (solid.shape == Template::box) {
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        const Vec2 corner =
            solid.centre_mm + Eigen::Rotation2Dd(solid.azimuth_rad) *
                                  Vec2(x * solid.half_axes_mm.x(), y * solid.half_axes_mm.y());
        points.emplace_back(corner.x(), corner.y(), 0.0);
        points.emplace_back(corner.x(), corner.y(), solid.height_mm);
      }
    }
    return points;
  }
  for (int ring = 0; ring <= kRings; ++ring) {
    const double share = static_cast<double>(ring) / kRings;
    for (int step = 0; step < kOutlineSteps; ++step) {
      const double angle = 2.0 * std::numbers::pi * step / kOutlineSteps;
      const Vec2 place = solid.centre_mm + section(solid.shape, share) * direction(solid, angle);
      points.emplace_back(place.x(), place.y(), share * solid.height_mm);
    }
  }
  return points;
}

SilhouetteFit fit_silhouette(const ItemView& view, Template shape,
                             const std::function<double(double footprint_mm2)>& height_mm) {
  const cv::Ptr<OverlapCost> cost = cv::makePtr<OverlapCost>(view, shape, height_mm);
  const std::array<double, 5> start = start_of(view);
  cv::Mat_<double> x(1, 5);
  std::copy(start.begin(), start.end(), x.begin());
  // A fifth of an item's usual size, and of a right angle.
  const cv::Mat_<double> step = (cv::Mat_<double>(1, 5) << 8.0, 8.0, 0.2, 0.2, 0.3);
  const auto solver = cv::DownhillSolver::create(
      cost, step,
      cv::TermCriteria(cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, kMaxEvaluations, 1e-4));
  solver->minimize(x);
  const Solid solid = cost->solid(x.ptr<double>());
  return {solid, cost->overlap(solid)};
}

Vec3 sight_at_height(const ItemView& view, const Vec2& pixel, double height_mm) {
  const Pose dish_from_camera = view.camera_from_dish.inverse();
  const Vec3 sight = dish_from_camera.rotation * view.camera.ray(pixel).homogeneous();
  const Vec3& eye = dish_from_camera.translation;
  return eye + sight * ((height_mm - eye.z()) / sight.z());
}

}  // namespace traygauge::tables
