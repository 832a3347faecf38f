#include <algorithm>
#include <cstdint>

#include "core/image/resample.hpp"

namespace traygauge {
namespace {

constexpr int kShareBits = 11;  // of a pixel; two shares and a grey value fill 30 bits
constexpr std::uint32_t kWhole = 1U << kShareBits;

// The two source pixels about a target pixel along one axis.
struct Neighbours {
  int first = 0;
  int second = 0;
  std::uint32_t second_share = 0;  // of kWhole
};

// Where target pixels lie in the source along one axis, counted in 1 / kWhole of a pixel.
class LinearAxis {
 public:
  LinearAxis(int source_size, int target_size)
      : last_(source_size - 1),
        step_((static_cast<std::int64_t>(source_size) << kFineBits) / target_size),
        start_(step_ / 2 - (std::int64_t{1} << (kFineBits - 1))) {}

  Neighbours at(int target) const {
    const std::int64_t fine = std::max(std::int64_t{0}, start_ + target * step_);
    const auto place = static_cast<std::uint32_t>(fine >> (kFineBits - kShareBits));
    const int first = std::min(static_cast<int>(place >> kShareBits), last_);
    return {first, std::min(first + 1, last_), place % kWhole};
  }

 private:
  static constexpr int kFineBits = 24;  // over 4096 pixels the step's rounding adds up to less than a share
  int last_;
  std::int64_t step_;
  std::int64_t start_;
};

}  // namespace

void enlarge_linear(ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target) {
  const LinearAxis across(source.width, target.width);
  const LinearAxis down(source.height, target.height);
  for (int y = 0; y < target.height; ++y) {
    const Neighbours rows = down.at(y);
    const std::uint8_t* upper = source.row(rows.first);
    const std::uint8_t* lower = source.row(rows.second);
    std::uint8_t* out = target.row(y);
    for (int x = 0; x < target.width; ++x) {
      const auto [left, right, share] = across.at(x);
      const std::uint32_t above = (kWhole - share) * upper[left] + share * upper[right];
      const std::uint32_t below = (kWhole - share) * lower[left] + share * lower[right];
      const std::uint32_t sum = (kWhole - rows.second_share) * above + rows.second_share * below;
      out[x] = static_cast<std::uint8_t>((sum + kWhole * kWhole / 2) / (kWhole * kWhole));
    }
  }
}

}  // namespace traygauge
