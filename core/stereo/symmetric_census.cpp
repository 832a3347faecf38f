#include "core/stereo/symmetric_census.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "core/stereo/row_lanes.hpp"

namespace traygauge {
namespace {

constexpr int kReach = kSymmetricCensusColumns;
constexpr int kRows = 2 * kSymmetricCensusRows + 1;
constexpr int kBlock = static_cast<int>(sizeof(ByteLanes));  // neighbouring pixels of a row at a time
using Rows = std::array<const std::uint8_t*, static_cast<std::size_t>(kRows)>;

struct Offset {
  int x = 0;
  int y = 0;
};

// Of the pixel below or on the right; the one opposite is its negative. The highest bit of a code first.
constexpr std::array<Offset, kSymmetricCensusBits> kOffsets = [] {
  std::array<Offset, kSymmetricCensusBits> offsets{};
  std::size_t bit = 0;
  for (int dy = 0; dy <= kSymmetricCensusRows; ++dy) {
    for (int dx = dy == 0 ? 1 : -kReach; dx <= kReach; ++dx) offsets[bit++] = {dx, dy};
  }
  return offsets;
}();

// What a bit says about two pixels opposite each other, and the pixel between them: all ones where it is set.
struct IsGreater {
  ByteLanes operator()(ByteLanes a, ByteLanes b, ByteLanes) const {
    return reinterpret_cast<ByteLanes>(a > b);
  }
};
struct IsAlike {
  ByteLanes operator()(ByteLanes a, ByteLanes b, ByteLanes centre) const {
    return reinterpret_cast<ByteLanes>((a == centre) & (b == centre));
  }
};

// The first and the second halves of two vectors, lane beside lane.
ByteLanes interleave_first(ByteLanes a, ByteLanes b) {
  return __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
}
ByteLanes interleave_second(ByteLanes a, ByteLanes b) {
  return __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
}
CostLanes interleave_first(CostLanes a, CostLanes b) {
  return __builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11);
}
CostLanes interleave_second(CostLanes a, CostLanes b) {
  return __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15);
}

// Four bytes of each pixel's code come together from four registers.
void store_codes(const std::array<ByteLanes, 4>& bytes, std::uint32_t* codes) {
  static_assert(std::endian::native == std::endian::little, "the first byte is the lowest");
  const auto store = [&codes](CostLanes four) {
    std::memcpy(codes, &four, sizeof four);
    codes += sizeof four / sizeof *codes;
  };
  const auto store_half = [&](ByteLanes low_bytes, ByteLanes high_bytes) {
    const auto low = reinterpret_cast<CostLanes>(low_bytes);
    const auto high = reinterpret_cast<CostLanes>(high_bytes);
    store(interleave_first(low, high));
    store(interleave_second(low, high));
  };
  store_half(interleave_first(bytes[0], bytes[1]), interleave_first(bytes[2], bytes[3]));
  store_half(interleave_second(bytes[0], bytes[1]), interleave_second(bytes[2], bytes[3]));
}

// The bits from kFirst on, as the lowest of a byte.
template <class Bit, std::size_t kFirst, std::size_t... kBits>
ByteLanes collect_bits(const Rows& rows, std::index_sequence<kBits...>) {
  const auto middle = load_lanes<ByteLanes>(rows[kSymmetricCensusRows]);
  ByteLanes value{};
  const auto row = [&](int y) { return rows[static_cast<std::size_t>(y)]; };
  const auto add = [&](Offset offset) {
    const auto a = load_lanes<ByteLanes>(row(kSymmetricCensusRows + offset.y) + offset.x);
    const auto b = load_lanes<ByteLanes>(row(kSymmetricCensusRows - offset.y) - offset.x);
    value = value + value - Bit{}(a, b, middle);
  };
  (add(kOffsets[kFirst + kBits]), ...);
  return value;
}

// Of kBlock pixels from where `rows` points to, whose windows can be read.
template <class Bit>
void transform_block(const Rows& rows, std::uint32_t* codes) {
  static_assert(kSymmetricCensusBits == 31);
  const std::array<ByteLanes, 4> bytes = {
      collect_bits<Bit, 23>(rows, std::make_index_sequence<8>()),
      collect_bits<Bit, 15>(rows, std::make_index_sequence<8>()),
      collect_bits<Bit, 7>(rows, std::make_index_sequence<8>()),
      collect_bits<Bit, 0>(rows, std::make_index_sequence<7>()),
  };
  store_codes(bytes, codes);
}

// The same where windows or pixels lie beyond the picture's sides.
template <class Bit>
void transform_at_border(const Rows& rows, int left, int width, std::uint32_t* codes) {
  std::array<std::array<std::uint8_t, kBlock + 2 * kReach>, kRows> padded;
  Rows within{};
  const int from = std::max(0, left - kReach);
  const int to = std::min(width, left + kBlock + kReach);
  for (std::size_t i = 0; i < padded.size(); ++i) {
    auto* const inside = std::fill_n(padded[i].data(), from - (left - kReach), rows[i][0]);
    std::fill(std::copy(rows[i] + from, rows[i] + to, inside), padded[i].data() + padded[i].size(),
              rows[i][width - 1]);
    within[i] = padded[i].data() + kReach;
  }
  std::array<std::uint32_t, kBlock> block;
  transform_block<Bit>(within, block.data());
  std::copy_n(block.begin(), std::min(kBlock, width - left), codes + left);
}

template <class Bit>
void transform(ImageView<const std::uint8_t> picture, ImageView<std::uint32_t> codes) {
  for (int y = 0; y < picture.height; ++y) {
    Rows rows;
    for (int i = 0; i < kRows; ++i) {
      rows[static_cast<std::size_t>(i)] =
          picture.row(std::clamp(y + i - kSymmetricCensusRows, 0, picture.height - 1));
    }
    for (int left = 0; left < picture.width; left += kBlock) {
      if (left < kReach || left + kBlock + kReach > picture.width) {
        transform_at_border<Bit>(rows, left, picture.width, codes.row(y));
        continue;
      }
      Rows here;
      std::transform(rows.begin(), rows.end(), here.begin(),
                     [&](const std::uint8_t* row) { return row + left; });
      transform_block<Bit>(here, codes.row(y) + left);
    }
  }
}

}  // namespace

void transform_symmetric_census(ImageView<const std::uint8_t> picture, ImageView<std::uint32_t> codes) {
  transform<IsGreater>(picture, codes);
}

void mask_symmetric_census(ImageView<const std::uint8_t> labels, ImageView<std::uint32_t> masks) {
  transform<IsAlike>(labels, masks);
}

}  // namespace traygauge
