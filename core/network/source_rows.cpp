#include "core/network/source_rows.hpp"

#include <algorithm>

namespace traygauge {
namespace {

// How a cell of the input reads its source along one axis: from the nearer cell with weight 3, from the
// farther with weight 1, of cells that are half as many.
struct Neighbours {
  int near = 0;
  int far = 0;
};

Neighbours neighbours_of(int at, int count) {
  const int near = at / 2;
  return {near, std::clamp(at % 2 == 0 ? near - 1 : near + 1, 0, count - 1)};
}

// The source's first cell, of the cells that a row of the joined input is made of.
struct JoinedCells {
  std::int16_t* first = nullptr;
  int count = 0;
  int channels = 0;  // of all sources: from one cell to the next
};

// How a byte of the source is read.
struct AsUnsigned {
  std::int16_t operator()(std::uint8_t byte) const { return byte; }
};
struct AsSigned {
  std::int16_t operator()(std::uint8_t byte) const { return signed_value(byte); }
};

template <class Value>
void copy_cells(const TensorView& source, int y, bool is_enlarged, const JoinedCells& cells) {
  constexpr Value kValue;
  const std::uint8_t* from = source.row(is_enlarged ? y / 2 : y);
  const int own = source.shape.channels;
  for (int x = 0; x < cells.count; ++x) {
    const std::uint8_t* cell = from + std::ptrdiff_t{is_enlarged ? x / 2 : x} * own;
    std::int16_t* to = cells.first + std::ptrdiff_t{x} * cells.channels;
    for (int c = 0; c < own; ++c) to[c] = kValue(cell[c]);
  }
}

template <class Value>
void enlarge_cells(const TensorView& source, int y, const JoinedCells& cells) {
  constexpr Value kValue;
  const Neighbours rows = neighbours_of(y, source.shape.height);
  const std::uint8_t* near_row = source.row(rows.near);
  const std::uint8_t* far_row = source.row(rows.far);
  const int own = source.shape.channels;
  for (int x = 0; x < cells.count; ++x) {
    const Neighbours columns = neighbours_of(x, source.shape.width);
    const int near = columns.near * own;
    const int far = columns.far * own;
    std::int16_t* to = cells.first + std::ptrdiff_t{x} * cells.channels;
    for (int c = 0; c < own; ++c) {
      const int sum = 9 * kValue(near_row[near + c]) + 3 * kValue(near_row[far + c]) +
                      3 * kValue(far_row[near + c]) + kValue(far_row[far + c]);
      to[c] = static_cast<std::int16_t>((sum + 8) >> 4);
    }
  }
}

template <class Value>
void write_source(const TensorView& source, Enlargement enlargement, int y, const JoinedCells& cells) {
  if (enlargement == Enlargement::bilinear) {
    enlarge_cells<Value>(source, y, cells);
  } else {
    copy_cells<Value>(source, y, enlargement == Enlargement::nearest, cells);
  }
}

}  // namespace

void gather_row(const NetworkLayer& layer, const std::array<TensorView, kMaxLayerSources>& sources, int y,
                std::int16_t* row) {
  const int channels = layer.input.channels;
  const int width = layer.input.width;
  if (y < 0 || y >= layer.input.height) {
    std::fill_n(row, std::ptrdiff_t{width + 2} * channels, std::int16_t{0});
    return;
  }
  std::fill_n(row, channels, std::int16_t{0});
  std::fill_n(row + std::ptrdiff_t{width + 1} * channels, channels, std::int16_t{0});
  JoinedCells cells{row + channels, width, channels};
  for (std::size_t i = 0; i < static_cast<std::size_t>(layer.source_count); ++i) {
    const TensorView& source = sources[i];
    const Enlargement enlargement = layer.sources[i].enlargement;
    if (source.is_signed) {
      write_source<AsSigned>(source, enlargement, y, cells);
    } else {
      write_source<AsUnsigned>(source, enlargement, y, cells);
    }
    cells.first += source.shape.channels;
  }
}

}  // namespace traygauge
