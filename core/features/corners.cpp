#include "core/features/corners.hpp"

#include <algorithm>
#include <array>

namespace traygauge {
namespace {

// A strict order, so that equal responses do not depend on the search.
bool is_better(const Corner& a, const Corner& b) {
  if (a.response != b.response) return a.response > b.response;
  return a.y != b.y ? a.y < b.y : a.x < b.x;
}

// The label that surrounds a corner; false where another ground begins nearby.
bool find_label(ImageView<const std::uint8_t> labels, int label_scale, int x, int y, int margin,
                std::uint8_t& label) {
  if (labels.empty()) return true;
  const int centre_x = x * label_scale + label_scale / 2;
  const int centre_y = y * label_scale + label_scale / 2;
  const int diagonal = margin - margin / 4;
  const std::array<std::array<int, 2>, 9> offsets = {{{0, 0},
                                                      {margin, 0},
                                                      {-margin, 0},
                                                      {0, margin},
                                                      {0, -margin},
                                                      {diagonal, diagonal},
                                                      {diagonal, -diagonal},
                                                      {-diagonal, diagonal},
                                                      {-diagonal, -diagonal}}};
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const int column = centre_x + offsets[i][0];
    const int row = centre_y + offsets[i][1];
    if (!labels.contains(column, row)) return false;
    if (i == 0) label = labels.at(column, row);
    if (ground_of(labels.at(column, row)) != ground_of(label)) return false;
  }
  return true;
}

bool is_burnt(ImageView<const std::uint8_t> gray, int x, int y, std::uint8_t level) {
  for (int row = y - kCornerWindowRadius; row <= y + kCornerWindowRadius; ++row) {
    const std::uint8_t* pixels = gray.row(row) + x;
    if (*std::max_element(pixels - kCornerWindowRadius, pixels + kCornerWindowRadius + 1) >= level)
      return true;
  }
  return false;
}

// Greater than all eight neighbours, of which those before it in the scan may be equal.
bool is_peak(const std::array<const float*, 3>& rows, int x, float response) {
  const auto [above, row, below] = rows;
  return response >= above[x - 1] && response >= above[x] && response >= above[x + 1] &&
         response >= row[x - 1] && response > row[x + 1] && response > below[x - 1] && response > below[x] &&
         response > below[x + 1];
}

class Buckets {
 public:
  Buckets(ImageView<const std::uint8_t> gray, const CornerParams& params, CornerWorkspace& workspace)
      : cell_px_(params.cell_px),
        columns_(corner_cells(gray.width, params.cell_px)),
        count_(kGrounds * columns_ * corner_cells(gray.height, params.cell_px)),
        capacity_(static_cast<std::size_t>(params.candidates_per_cell)),
        workspace_(workspace) {
    std::fill_n(workspace_.counts.begin(), count_, std::uint8_t{0});
  }

  std::size_t count() const { return count_; }
  std::span<Corner> candidates(std::size_t bucket) const {
    return workspace_.candidates.subspan(bucket * capacity_, workspace_.counts[bucket]);
  }

  void add(const Corner& corner) {
    const std::size_t cell = static_cast<std::size_t>(corner.y / cell_px_) * columns_ +
                             static_cast<std::size_t>(corner.x / cell_px_);
    const std::size_t bucket = kGrounds * cell + static_cast<std::size_t>(ground_of(corner.label));
    std::uint8_t& count = workspace_.counts[bucket];
    Corner* first = &workspace_.candidates[bucket * capacity_];
    if (count == capacity_ && !is_better(corner, first[count - 1])) return;
    if (count < capacity_) ++count;
    Corner* place = first + count - 1;
    for (; place != first && is_better(corner, place[-1]); --place) *place = place[-1];
    *place = corner;
  }

  // Forgets what is much weaker than the best of its bucket.
  void drop_weak(float min_share_of_best) {
    for (std::size_t bucket = 0; bucket < count_; ++bucket) {
      const std::span<const Corner> list = candidates(bucket);
      std::uint8_t& count = workspace_.counts[bucket];
      while (count > 1 && list[count - 1U].response < min_share_of_best * list[0].response) --count;
    }
  }

 private:
  int cell_px_;
  std::size_t columns_;
  std::size_t count_;
  std::size_t capacity_;
  CornerWorkspace& workspace_;
};

void fill_buckets(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels, int label_scale,
                  const CornerParams& params, CornerWorkspace& workspace, Buckets& buckets) {
  CornerResponse response(gray, workspace.response);
  std::array<float*, 3> rows = {workspace.responses[0].data(), workspace.responses[1].data(),
                                workspace.responses[2].data()};
  const auto width = static_cast<std::size_t>(gray.width);
  for (std::size_t i = 0; i < 2; ++i) response.next_row({rows[i + 1], width});
  for (int y = response.first_row() + 1; y + 1 < response.end_row(); ++y) {
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
    response.next_row({rows[2], width});
    for (int x = kCornerBorder; x < gray.width - kCornerBorder; ++x) {
      const float value = rows[1][x];
      if (value < params.min_response || !is_peak({rows[0], rows[1], rows[2]}, x, value)) continue;
      Corner corner{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), value};
      if (is_burnt(gray, x, y, params.burnt_level)) continue;
      if (!find_label(labels, label_scale, x, y, params.label_margin_px, corner.label)) continue;
      buckets.add(corner);
    }
  }
}

}  // namespace

void find_corners(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels, int label_scale,
                  const CornerParams& params, Random& random, CornerWorkspace& workspace,
                  BoundedList<Corner>& corners) {
  corners.clear();
  constexpr int kSmallest = 2 * kCornerBorder + 3;
  if (gray.width < kSmallest || gray.height < kSmallest) return;
  Buckets buckets(gray, params, workspace);
  fill_buckets(gray, labels, label_scale, params, workspace, buckets);
  buckets.drop_weak(params.min_share_of_best);
  for (std::size_t round = 0; round < static_cast<std::size_t>(params.corners_per_cell); ++round) {
    for (std::size_t bucket = 0; bucket < buckets.count(); ++bucket) {
      const std::span<Corner> candidates = buckets.candidates(bucket);
      if (round >= candidates.size()) continue;
      const auto rest = static_cast<std::uint32_t>(candidates.size() - round);
      std::swap(candidates[round], candidates[round + random.below(rest)]);
      corners.push_back(candidates[round]);
    }
  }
}

}  // namespace traygauge
