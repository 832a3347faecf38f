#include "core/network/convolution.hpp"

#include <algorithm>
#include <cstring>

#include "core/network/rescaling.hpp"

namespace traygauge {
namespace {

// Two cells by four channels: eight sums of products of 16 bits, which the vectoriser knows (pmaddwd, smlal).
// `taps` is a multiple of kTapBlock.
void add_products(const std::int16_t* __restrict cells, const std::int16_t* __restrict weights,
                  std::size_t taps, std::int32_t* __restrict first, std::int32_t* __restrict second) {
  static_assert(kOutputBlock == 4 && kTileCells % 2 == 0);
  if (taps % kTapBlock != 0) __builtin_unreachable();
  const std::int16_t* __restrict a = cells;
  const std::int16_t* __restrict b = cells + taps;
  const std::int16_t* __restrict p = weights;
  const std::int16_t* __restrict q = p + taps;
  const std::int16_t* __restrict r = q + taps;
  const std::int16_t* __restrict s = r + taps;
  std::int32_t ap = 0;
  std::int32_t aq = 0;
  std::int32_t ar = 0;
  std::int32_t as = 0;
  std::int32_t bp = 0;
  std::int32_t bq = 0;
  std::int32_t br = 0;
  std::int32_t bs = 0;
  for (std::size_t k = 0; k < taps; ++k) {
    ap += a[k] * p[k];
    aq += a[k] * q[k];
    ar += a[k] * r[k];
    as += a[k] * s[k];
    bp += b[k] * p[k];
    bq += b[k] * q[k];
    br += b[k] * r[k];
    bs += b[k] * s[k];
  }
  first[0] = ap;
  first[1] = aq;
  first[2] = ar;
  first[3] = as;
  second[0] = bp;
  second[1] = bq;
  second[2] = br;
  second[3] = bs;
}

class Convolution {
 public:
  Convolution(const NetworkLayer& layer, const PackedLayer& packed, NetworkWorkspace& workspace)
      : layer_(layer),
        packed_(packed),
        workspace_(workspace),
        taps_(NetworkPlan::padded_taps(layer)),
        channels_(NetworkPlan::padded_channels(layer)) {}

  void run(const std::array<TensorView, kMaxLayerSources>& sources, std::uint8_t* output) {
    const int reach = layer_.kernel / 2;
    int gathered = -reach;  // the next row of the input
    for (int y = 0; y < layer_.output.height; ++y) {
      const int last = y * layer_.stride + reach;
      for (; gathered <= last; ++gathered) gather_row(layer_, sources, gathered, ring_row(gathered));
      std::uint8_t* row = output + static_cast<std::ptrdiff_t>(layer_.output.row_bytes()) * y;
      for (int x = 0; x < layer_.output.width; x += static_cast<int>(kTileCells)) {
        const int count = std::min(static_cast<int>(kTileCells), layer_.output.width - x);
        collect_patch(x, y, count);
        sum_products(count);
        write_cells(count, row + static_cast<std::ptrdiff_t>(x) * layer_.output.channels);
      }
    }
  }

 private:
  std::int16_t* ring_row(int y) const {
    constexpr int kRows = kRingRows;
    return workspace_.rows[static_cast<std::size_t>((y + kRows) % kRows)].data();
  }

  // What each cell of the tile reads, one cell after the other. Beyond a cell's taps anything may stand: the
  // weights there are 0.
  void collect_patch(int x, int y, int count) {
    const int reach = layer_.kernel / 2;
    const auto run =
        static_cast<std::size_t>(layer_.kernel) * static_cast<std::size_t>(layer_.input.channels);
    for (int i = 0; i < count; ++i) {
      std::int16_t* to = workspace_.patch.data() + static_cast<std::size_t>(i) * taps_;
      // A row's first cell is the one beside the input's left end.
      const std::ptrdiff_t column = (x + i) * layer_.stride - reach + 1;
      for (int k = 0; k < layer_.kernel; ++k, to += run) {
        const std::int16_t* from = ring_row(y * layer_.stride - reach + k) + column * layer_.input.channels;
        std::memcpy(to, from, run * sizeof(std::int16_t));
      }
    }
  }

  // Cells come in pairs: of an odd count, the last is computed beside one whose sums nobody reads.
  void sum_products(int count) {
    for (std::size_t c = 0; c < channels_; c += kOutputBlock) {
      const std::int16_t* weights = packed_.weights.data() + c * taps_;
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); i += 2) {
        std::int32_t* sums = workspace_.sums.data() + i * channels_ + c;
        add_products(workspace_.patch.data() + i * taps_, weights, taps_, sums, sums + channels_);
      }
    }
  }

  void write_cells(int count, std::uint8_t* cells) {
    const auto channels = static_cast<std::size_t>(layer_.output.channels);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i, cells += channels) {
      const std::int32_t* sums = workspace_.sums.data() + i * channels_;
      for (std::size_t c = 0; c < channels; ++c) {
        const std::int32_t sum = sums[c] + packed_.biases[c];
        cells[c] = saturate(rescale(sum, packed_.multipliers[c], packed_.shifts[c]), layer_.has_relu);
      }
    }
  }

  const NetworkLayer& layer_;
  const PackedLayer& packed_;
  NetworkWorkspace& workspace_;
  std::size_t taps_;
  std::size_t channels_;
};

}  // namespace

void convolve(const NetworkLayer& layer, const PackedLayer& packed,
              const std::array<TensorView, kMaxLayerSources>& sources, NetworkWorkspace& workspace,
              std::uint8_t* output) {
  Convolution(layer, packed, workspace).run(sources, output);
}

}  // namespace traygauge
