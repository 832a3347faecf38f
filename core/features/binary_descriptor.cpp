#include "core/features/binary_descriptor.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"

namespace traygauge {
namespace {

constexpr int kMomentRadius = kBinaryPatchRadius - 1;

// Cosine and sine of one step of orientation, by halving the right angle: square roots are exact everywhere.
Vec2 one_turn() {
  double cosine = 0.0;
  for (int steps = 4; steps < kBinaryTurns; steps *= 2) cosine = std::sqrt(0.5 * (1.0 + cosine));
  return {cosine, std::sqrt(1.0 - cosine * cosine)};
}

std::array<std::int8_t, 2> rounded(const Vec2& v) {
  return {static_cast<std::int8_t>(std::lround(v.x())), static_cast<std::int8_t>(std::lround(v.y()))};
}

// A place in the patch, denser towards its middle: the sum of two uniform draws.
Vec2 draw_place(Random& random) {
  constexpr double kReach = kBinaryPatchRadius - 2.0;
  for (;;) {
    Vec2 place(kReach * (random.uniform() + random.uniform() - 1.0),
               kReach * (random.uniform() + random.uniform() - 1.0));
    if (place.squaredNorm() <= kReach * kReach) return place;
  }
}

}  // namespace

void BinarySampling::draw(std::uint64_t seed) {
  Random random(seed);
  const Vec2 turn = one_turn();
  directions_[0] = Vec2::UnitX();
  for (std::size_t i = 1; i < directions_.size(); ++i) directions_[i] = turned_by(directions_[i - 1], turn);
  for (std::size_t i = 0; i < turns_[0].size(); ++i) {
    Vec2 first = draw_place(random);
    Vec2 second = draw_place(random);
    for (auto& comparisons : turns_) {
      comparisons[i] = {rounded(first), rounded(second)};
      first = turned_by(first, turn);
      second = turned_by(second, turn);
    }
  }
}

const std::array<BinarySampling::Comparison, 256>& BinarySampling::turned_towards(
    const Vec2& direction) const {
  const auto* const nearest =
      std::max_element(directions_.begin(), directions_.end(),
                       [&](const Vec2& a, const Vec2& b) { return a.dot(direction) < b.dot(direction); });
  return turns_[static_cast<std::size_t>(nearest - directions_.begin())];
}

bool describe_binary(ImageView<const std::uint8_t> smooth, int x, int y, const BinarySampling& sampling,
                     BinaryDescriptor& descriptor, Vec2& direction) {
  constexpr int kRadius = kBinaryPatchRadius;
  if (x < kRadius || y < kRadius || x >= smooth.width - kRadius || y >= smooth.height - kRadius) return false;
  int moment_x = 0;
  int moment_y = 0;
  for (int dy = -kMomentRadius; dy <= kMomentRadius; ++dy) {
    const std::uint8_t* row = smooth.row(y + dy) + x;
    int half = kMomentRadius;
    while (half * half + dy * dy > kMomentRadius * kMomentRadius) --half;
    int sum = 0;
    for (int dx = -half; dx <= half; ++dx) {
      sum += row[dx];
      moment_x += dx * row[dx];
    }
    moment_y += dy * sum;
  }
  const Vec2 moment(moment_x, moment_y);
  const double length = moment.norm();
  if (!(length > 0.0)) return false;
  direction = moment / length;
  const auto& comparisons = sampling.turned_towards(direction);
  const std::uint8_t* corner = smooth.row(y) + x;
  for (std::size_t word = 0; word < descriptor.size(); ++word) {
    std::uint64_t bits = 0;
    for (std::size_t bit = 0; bit < 64; ++bit) {
      const BinarySampling::Comparison& c = comparisons[64 * word + bit];
      const std::uint8_t first = corner[c.first[1] * smooth.stride + c.first[0]];
      const std::uint8_t second = corner[c.second[1] * smooth.stride + c.second[0]];
      bits |= static_cast<std::uint64_t>(first < second) << bit;
    }
    descriptor[word] = bits;
  }
  return true;
}

void box_blur(ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target) {
  const auto copy_row = [&](int y) { std::copy_n(source.row(y), source.width, target.row(y)); };
  copy_row(0);
  for (int y = 1; y + 1 < source.height; ++y) {
    const std::uint8_t* above = source.row(y - 1);
    const std::uint8_t* row = source.row(y);
    const std::uint8_t* below = source.row(y + 1);
    std::uint8_t* out = target.row(y);
    out[0] = row[0];
    out[source.width - 1] = row[source.width - 1];
    for (int x = 1; x + 1 < source.width; ++x) {
      const int sum = above[x - 1] + above[x] + above[x + 1] + row[x - 1] + row[x] + row[x + 1] +
                      below[x - 1] + below[x] + below[x + 1];
      out[x] = static_cast<std::uint8_t>((sum * 7282 + 32768) >> 16);  // sum / 9, rounded
    }
  }
  copy_row(source.height - 1);
}

}  // namespace traygauge
