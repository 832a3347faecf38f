#include "simulator/render/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "simulator/render/shared_work.hpp"

namespace traygauge {
namespace {

void expect(bool holds, const std::string& text) {
  if (!holds) throw std::invalid_argument("sensor settings: " + text);
}

// Box and Muller's method, one of its two values.
double draw_normal(Random& random) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * random.uniform());
}

// IEC 61966-2-1.
double tone(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

// The cosine law: a share of cos⁴ of the angle to the axis, whose tangent grows with the distance from the
// centre.
class Vignetting {
 public:
  Vignetting(int width, int height, double corner_loss)
      : center_x_(0.5 * (width - 1)),
        center_y_(0.5 * (height - 1)),
        per_square_px_((1.0 / std::sqrt(1.0 - corner_loss) - 1.0) /
                       std::max(center_x_ * center_x_ + center_y_ * center_y_, 1.0)) {}

  double at(int x, int y) const {
    const double square = (x - center_x_) * (x - center_x_) + (y - center_y_) * (y - center_y_);
    const double secant2 = 1.0 + per_square_px_ * square;
    return 1.0 / (secant2 * secant2);
  }

 private:
  double center_x_, center_y_, per_square_px_;
};

}  // namespace

void SensorSettings::check() const {
  expect(exposure > 0.0, "exposure must be positive");
  expect(white_balance.minCoeff() > 0.0, "white_balance must be positive");
  expect(corner_loss >= 0.0 && corner_loss < 1.0, "corner_loss must be from 0 to below 1");
  expect(full_well_electrons >= 1.0, "full_well_electrons must be at least 1");
  expect(read_noise_electrons >= 0.0, "read_noise_electrons must not be negative");
}

Picture develop(const RenderedView& view, const SensorSettings& settings, std::uint64_t seed, int threads) {
  settings.check();
  Picture picture({view.width, view.height}, PixelFormat::rgb8);
  const Vignetting vignetting(view.width, view.height, settings.corner_loss);
  const double read_variance = settings.read_noise_electrons * settings.read_noise_electrons;
  // A row draws from its own sequence, whichever thread develops it.
  std::vector<std::uint64_t> row_seeds(static_cast<std::size_t>(view.height));
  Random random(seed);
  for (std::uint64_t& row_seed : row_seeds)
    row_seed = (static_cast<std::uint64_t>(random.next()) << 32U) | random.next();
  share_work(view.height, threads, {}, [&](int y) {
    Random noise(row_seeds[static_cast<std::size_t>(y)]);
    std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width);
    for (int x = 0; x < view.width; ++x, ++pixel) {
      const Eigen::Vector3f& radiance = view.radiance[pixel];
      const double gain = settings.exposure * vignetting.at(x, y) * settings.full_well_electrons;
      for (Eigen::Index color = 0; color < 3; ++color) {
        // Poisson's noise and the amplifier's as one Gaussian: the counts that matter are above 20.
        const double mean = std::max(gain * static_cast<double>(radiance[color]), 0.0);
        const double noisy = mean + std::sqrt(mean + read_variance) * draw_normal(noise);
        const double share =
            std::min(noisy / settings.full_well_electrons, 1.0) * settings.white_balance[color];
        picture.pixels[3 * pixel + static_cast<std::size_t>(color)] =
            static_cast<std::uint8_t>(std::lround(255.0 * tone(std::clamp(share, 0.0, 1.0))));
      }
    }
  });
  return picture;
}

}  // namespace traygauge
