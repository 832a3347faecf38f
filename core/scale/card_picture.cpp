#include "core/scale/card_picture.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/table_frame.hpp"

namespace traygauge {
namespace {

constexpr int kGrayBins = 256;

std::uint64_t mask_of(CardSampling sampling) {
  switch (sampling) {
    case CardSampling::half:
      return 0xAA55AA55AA55AA55U;
    case CardSampling::quarter:
      return 0x0055005500550055U;
    case CardSampling::sixteenth:
      return 0x0000004400000044U;
    default:
      return ~std::uint64_t{0};
  }
}

// How a tile lies on the print under a pose; mm from the print's top left corner, right and down.
struct TilePlace {
  Vec2 centre = Vec2::Zero();
  Eigen::Matrix2d by_pixel = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d by_ray = Eigen::Matrix2d::Zero();
  double depth = 0.0;  // along the optical axis, mm; 0: nowhere near the print

  bool valid() const { return depth > 0.0; }
};

constexpr double kMinDepthMm = 1.0;
constexpr double kMaxDistanceShare = 4.0;  // of a tile from the print's corner, in widths and heights

// The map from rays to the print that a pose implies.
class PrintPlane {
 public:
  PrintPlane(const Pose& camera_from_table, const CardModelSize& size)
      : pose_(camera_from_table), size_(size) {
    ray_from_print_ << pose_.rotation.col(0), -pose_.rotation.col(1),
        pose_.rotation.col(2) * size.thickness_mm + pose_.translation;
    print_from_ray_ = ray_from_print_.inverse();
  }

  TilePlace place(const CardTile& tile) const {
    TilePlace place;
    const Vec3 mapped = print_from_ray_ * tile.ray.homogeneous();
    if (!(mapped.z() > 0.0) || mapped.z() > 1.0 / kMinDepthMm) return place;
    place.centre = mapped.head<2>() / mapped.z();
    if (!(normalised(place.centre).cwiseAbs().maxCoeff() < kMaxDistanceShare)) return place;
    place.by_ray =
        (print_from_ray_.topLeftCorner<2, 2>() - place.centre * print_from_ray_.block<1, 2>(2, 0)) /
        mapped.z();
    place.by_pixel = place.by_ray * tile.ray_by_pixel;
    place.depth = 1.0 / mapped.z();
    return place;
  }

  // Where the print under a fixed ray moves with the pose's step.
  Eigen::Matrix<double, 2, 6> print_by_step(const TilePlace& place, const Vec2& ray) const {
    const Vec3 turned = pose_.rotation * print_point_mm(place.centre, size_.thickness_mm);
    Eigen::Matrix<double, 2, 6> ray_by_step;
    for (int row = 0; row < 2; ++row) {
      const Vec3 by_point = (Vec3::Unit(row) - ray(row) * Vec3::UnitZ()) / place.depth;
      ray_by_step.row(row) << turned.cross(by_point).transpose(), by_point.transpose();
    }
    return -place.by_ray * ray_by_step;
  }

  Vec2 normalised(const Vec2& print_mm) const {
    return {2.0 * print_mm.x() / size_.width_mm - 1.0, 2.0 * print_mm.y() / size_.height_mm - 1.0};
  }

 private:
  Pose pose_;
  CardModelSize size_;
  Mat3 ray_from_print_;
  Mat3 print_from_ray_;
};

// The print's grey value and its slope per level pixel.
struct PrintSample {
  float gray;
  float by_x;
  float by_y;
};

// Linear interpolation of a level along a tile's pixels.
class TileSampler {
 public:
  TileSampler(const CardPatternLevel& level, const TilePlace& place)
      : data_(level.gray.data),
        stride_(level.gray.stride),
        max_x_(static_cast<float>(level.gray.width) - 1.001F),
        max_y_(static_cast<float>(level.gray.height) - 1.001F) {
    const Eigen::Matrix2d step = level.px_per_mm.asDiagonal() * place.by_pixel;
    const Vec2 centre = (level.px_per_mm.cwiseProduct(place.centre).array() - 0.5).matrix();
    const Vec2 first = centre - step * Vec2::Constant(0.5 * (kCardTileSide - 1));
    first_x_ = static_cast<float>(first.x());
    first_y_ = static_cast<float>(first.y());
    x_by_column_ = static_cast<float>(step(0, 0));
    x_by_row_ = static_cast<float>(step(0, 1));
    y_by_column_ = static_cast<float>(step(1, 0));
    y_by_row_ = static_cast<float>(step(1, 1));
  }

  PrintSample at(int column, int row) const {
    const auto c = static_cast<float>(column);
    const auto r = static_cast<float>(row);
    const float x = std::clamp(first_x_ + c * x_by_column_ + r * x_by_row_, 0.0F, max_x_);
    const float y = std::clamp(first_y_ + c * y_by_column_ + r * y_by_row_, 0.0F, max_y_);
    const int left = static_cast<int>(x);
    const int top = static_cast<int>(y);
    const float fx = x - static_cast<float>(left);
    const float fy = y - static_cast<float>(top);
    const std::uint8_t* upper = data_ + top * stride_ + left;
    const std::uint8_t* lower = upper + stride_;
    const float a = upper[0];
    const float b = upper[1];
    const float c0 = lower[0];
    const float d = lower[1];
    const float above = a + fx * (b - a);
    const float below = c0 + fx * (d - c0);
    return {above + fy * (below - above), (b - a) + fy * ((d - c0) - (b - a)), below - above};
  }

 private:
  const std::uint8_t* data_;
  std::ptrdiff_t stride_;
  float max_x_;
  float max_y_;
  float first_x_ = 0.0F;
  float first_y_ = 0.0F;
  float x_by_column_ = 0.0F;
  float x_by_row_ = 0.0F;
  float y_by_column_ = 0.0F;
  float y_by_row_ = 0.0F;
};

// Weighted sums over a tile's samples of the products of (by_x, by_y, gray, 1) among themselves and with the
// residual.
struct TileSums {
  std::array<float, 10> products{};  // lower triangle by rows
  std::array<float, 4> residuals{};

  void add(const PrintSample& print, float residual, float weight) {
    const std::array<float, 4> v = {print.by_x, print.by_y, print.gray, 1.0F};
    std::size_t k = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const float scaled = weight * v[i];
      residuals[i] += scaled * residual;
      for (std::size_t j = 0; j <= i; ++j) products[k++] += scaled * v[j];
    }
  }
};

using Histogram = std::array<std::uint32_t, kGrayBins>;

double median_of(const Histogram& histogram, int count) {
  int below = 0;
  for (int bin = 0; bin < kGrayBins; ++bin) {
    const auto here = static_cast<int>(histogram[static_cast<std::size_t>(bin)]);
    if (2 * (below + here) >= count) return bin + (0.5 * count - below) / std::max(here, 1);
    below += here;
  }
  return kGrayBins;
}

// Adds a tile's sums, whose four terms move with the 12 parameters by `by_parameter`.
void add_tile(const TileSums& sums, const Eigen::Matrix<double, 4, 12>& by_parameter, CardLinearisation& to) {
  Eigen::Matrix4d products;
  Eigen::Vector4d residuals;
  std::size_t k = 0;
  for (int i = 0; i < 4; ++i) {
    residuals[i] = sums.residuals[static_cast<std::size_t>(i)];
    for (int j = 0; j <= i; ++j) products(i, j) = products(j, i) = sums.products[k++];
  }
  const Eigen::Matrix<double, 4, 12> half = products * by_parameter;
  const Eigen::Matrix<double, 12, 1> gradient = by_parameter.transpose() * residuals;
  to.equations.hessian.noalias() += by_parameter.transpose() * half;
  to.equations.gradient -= gradient;
  to.scatter.noalias() += gradient * gradient.transpose();
}

}  // namespace

Status CardPicture::load(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels,
                         const PixelBox& box, const LensModel& lens, const CardPictureParams& params) {
  gray_ = gray;
  tiles_ = {};
  labelled_ = used_ = 0;
  const int e = params.erosion_px;
  const int left = std::max(box.left, e);
  const int top = std::max(box.top, e);
  const int right = std::min(box.right, labels.width - e);
  const int bottom = std::min(box.bottom, labels.height - e);
  const int columns = std::max(0, (right - left) / kCardTileSide);
  const int rows = std::max(0, (bottom - top) / kCardTileSide);
  const auto is_card = [&](int x, int y) { return labels.at(x, y) == kCardLabel; };
  // Half a box is card at the least when it lies askew, so this keeps all tiles of usual cards.
  const int every = 1 + columns * rows / (2 * std::max(1, static_cast<int>(storage_.size())));
  std::size_t count = 0;
  for (int i = 0; i < columns * rows && count < storage_.size(); i += every) {
    CardTile tile;
    tile.x = left + i % columns * kCardTileSide;
    tile.y = top + i / columns * kCardTileSide;
    for (int bit = 0; bit < 64; ++bit) {
      const int x = tile.x + bit % 8;
      const int y = tile.y + bit / 8;
      if (is_card(x, y) && is_card(x - e, y) && is_card(x + e, y) && is_card(x, y - e) && is_card(x, y + e)) {
        tile.labelled |= std::uint64_t{1} << bit;
      }
    }
    const Vec2 centre(tile.x + 0.5 * (kCardTileSide - 1), tile.y + 0.5 * (kCardTileSide - 1));
    Vec2 along_x;
    Vec2 along_y;
    if (tile.labelled == 0 || !lens.undistort_pixel(centre, tile.ray) ||
        !lens.undistort_pixel(centre + Vec2::UnitX(), along_x) ||
        !lens.undistort_pixel(centre + Vec2::UnitY(), along_y)) {
      continue;
    }
    tile.ray_by_pixel << along_x - tile.ray, along_y - tile.ray;
    labelled_ += std::popcount(tile.labelled);
    storage_[count++] = tile;
  }
  tiles_ = storage_.first(count);
  return labelled_ > 0 ? StatusCode::ok : StatusCode::card_not_found;
}

void CardPicture::select(const Pose& camera_from_table, const CardModelSize& size, double margin_mm) {
  const PrintPlane plane(camera_from_table, size);
  const Vec2 middle(0.5 * size.width_mm, 0.5 * size.height_mm);
  const Vec2 inside = (middle.array() - margin_mm).matrix();
  used_ = 0;
  for (CardTile& tile : tiles_) {
    tile.used = 0;
    const TilePlace place = plane.place(tile);
    if (!place.valid()) continue;
    for (std::uint64_t rest = tile.labelled; rest != 0; rest &= rest - 1) {
      const int bit = std::countr_zero(rest);
      const Vec2 offset(bit % 8 - 3.5, bit / 8 - 3.5);
      const Vec2 from_middle = place.centre + place.by_pixel * offset - middle;
      const bool is_inside = std::abs(from_middle.x()) < inside.x() && std::abs(from_middle.y()) < inside.y();
      if (is_inside) tile.used |= std::uint64_t{1} << bit;
    }
    used_ += std::popcount(tile.used);
  }
}

CardCorrelation CardPicture::correlate(const Pose& camera_from_table, const CardModelSize& size,
                                       const CardPatternLevel& level, CardSampling sampling) const {
  const PrintPlane plane(camera_from_table, size);
  const std::uint64_t mask = mask_of(sampling);
  CardCorrelation result;
  double print = 0.0;
  double picture = 0.0;
  double print_print = 0.0;
  double picture_picture = 0.0;
  double print_picture = 0.0;
  for (const CardTile& tile : tiles_) {
    if ((tile.used & mask) == 0) continue;
    const TilePlace place = plane.place(tile);
    if (!place.valid()) continue;
    const TileSampler sampler(level, place);
    std::array<float, 5> sums{};
    for (std::uint64_t rest = tile.used & mask; rest != 0; rest &= rest - 1) {
      const int bit = std::countr_zero(rest);
      const float p = sampler.at(bit % 8, bit / 8).gray;
      const auto g = static_cast<float>(gray_.at(tile.x + bit % 8, tile.y + bit / 8));
      sums[0] += p;
      sums[1] += g;
      sums[2] += p * p;
      sums[3] += g * g;
      sums[4] += p * g;
    }
    print += sums[0];
    picture += sums[1];
    print_print += sums[2];
    picture_picture += sums[3];
    print_picture += sums[4];
    result.samples += std::popcount(tile.used & mask);
  }
  if (result.samples < 2) return result;
  const double n = result.samples;
  const double varies = print_print - print * print / n;
  const double picture_varies = picture_picture - picture * picture / n;
  const double together = print_picture - print * picture / n;
  if (!(varies > n) || !(picture_varies > n)) return result;  // flat to one grey value: nothing to compare
  result.correlation = together / std::sqrt(varies * picture_varies);
  result.tone[0] = together / varies;
  result.tone[3] = (picture - result.tone[0] * print) / n;
  result.rms_gray = std::sqrt(std::max(0.0, picture_varies - together * together / varies) / n);
  return result;
}

CardLinearisation CardPicture::linearise(const Pose& camera_from_table, const CardModelSize& size,
                                         const CardPatternLevel& level, const CardTone& tone,
                                         double cutoff_gray, CardSampling sampling) const {
  const PrintPlane plane(camera_from_table, size);
  const std::uint64_t mask = mask_of(sampling);
  const auto inverse_cutoff = static_cast<float>(1.0 / cutoff_gray);
  CardLinearisation result;
  result.scatter.setZero();
  Histogram histogram{};
  for (const CardTile& tile : tiles_) {
    if ((tile.used & mask) == 0) continue;
    const TilePlace place = plane.place(tile);
    if (!place.valid()) continue;
    const Vec2 at = plane.normalised(place.centre);
    const Vec3 linear(1.0, at.x(), at.y());
    const double gain = tone.head<3>().dot(linear);
    const auto gain_f = static_cast<float>(gain);
    const auto offset_f = static_cast<float>(tone.tail<3>().dot(linear));
    const TileSampler sampler(level, place);
    TileSums sums;
    float weights = 0.0F;
    float slopes = 0.0F;
    for (std::uint64_t rest = tile.used & mask; rest != 0; rest &= rest - 1) {
      const int bit = std::countr_zero(rest);
      const PrintSample print = sampler.at(bit % 8, bit / 8);
      const auto gray = static_cast<float>(gray_.at(tile.x + bit % 8, tile.y + bit / 8));
      const float residual = gray - gain_f * print.gray - offset_f;
      const float ratio = residual * inverse_cutoff;
      const float root = 1.0F / (1.0F + ratio * ratio);
      const float weight = root * root;
      sums.add(print, residual, weight);
      weights += weight;
      slopes += weight * (4.0F * root - 3.0F);
      ++histogram[static_cast<std::size_t>(std::min(255.0F, std::abs(residual)))];
    }
    const Eigen::Matrix<double, 2, 6> by_step = plane.print_by_step(place, tile.ray);
    Eigen::Matrix<double, 4, 12> by_parameter = Eigen::Matrix<double, 4, 12>::Zero();
    by_parameter.topLeftCorner<2, 6>() = gain * level.px_per_mm.asDiagonal() * by_step;
    by_parameter.block<1, 3>(2, 6) = linear.transpose();
    by_parameter.block<1, 3>(3, 9) = linear.transpose();
    add_tile(sums, by_parameter, result);
    result.weights += weights;
    result.slope += slopes;
    result.samples += std::popcount(tile.used & mask);
  }
  result.spread_gray = 1.4826 * median_of(histogram, result.samples);
  return result;
}

}  // namespace traygauge
