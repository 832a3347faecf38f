#include "core/features/corners.hpp"

#include <algorithm>

#include "core/base/units.hpp"

namespace traygauge {
namespace {

// The label that surrounds a corner; false where another ground begins nearby.
bool find_label(const CornerPicture& picture, int margin, Corner& corner) {
  const ImageView<const std::uint8_t> labels = picture.labels;
  if (labels.empty()) return true;
  const int x = corner.x * picture.label_scale + picture.label_scale / 2;
  const int y = corner.y * picture.label_scale + picture.label_scale / 2;
  if (x < margin || y < margin || x >= labels.width - margin || y >= labels.height - margin) return false;
  corner.label = labels.at(x, y);
  const Ground ground = ground_of(corner.label);
  const int diagonal = margin - margin / 4;
  const std::array<std::array<int, 2>, 8> offsets = {{{margin, 0},
                                                      {-margin, 0},
                                                      {0, margin},
                                                      {0, -margin},
                                                      {diagonal, diagonal},
                                                      {diagonal, -diagonal},
                                                      {-diagonal, diagonal},
                                                      {-diagonal, -diagonal}}};
  return std::all_of(offsets.begin(), offsets.end(), [&](const std::array<int, 2>& offset) {
    return ground_of(labels.at(x + offset[0], y + offset[1])) == ground;
  });
}

bool is_burnt(ImageView<const std::uint8_t> gray, const Corner& corner, std::uint8_t level) {
  constexpr int kRadius = kCornerWindowRadius;
  for (int y = corner.y - kRadius; y <= corner.y + kRadius; ++y) {
    const std::uint8_t* pixels = gray.row(y) + corner.x;
    if (*std::max_element(pixels - kRadius, pixels + kRadius + 1) >= level) return true;
  }
  return false;
}

// Keeps responses of at least `least` that exceed all eight neighbours (those before it in the scan may be
// equal), and makes the others 0. Written for the vectoriser: nearly all pixels fail.
void keep_peaks(const float* __restrict above, const float* __restrict row, const float* __restrict below,
                int width, float least, float* __restrict peaks) {
  for (int x = kCornerBorder; x < width - kCornerBorder; ++x) {
    const float before = std::max(std::max(above[x - 1], above[x]), std::max(above[x + 1], row[x - 1]));
    const float after = std::max(std::max(below[x - 1], below[x]), std::max(below[x + 1], row[x + 1]));
    const float kept = row[x] >= std::max(before, least) ? row[x] : 0.0F;
    peaks[x] = row[x] > after ? kept : 0.0F;
  }
}

class CornerBuckets {
 public:
  CornerBuckets(const CornerGrid& grid, const CornerParams& params, CornerWorkspace& workspace)
      : grid_(grid),
        capacity_(static_cast<std::size_t>(params.candidates_per_bucket)),
        workspace_(workspace) {
    std::fill_n(workspace_.counts.begin(), count(), std::uint8_t{0});
  }

  std::size_t count() const { return kGrounds * grid_.cells(); }
  std::span<Corner> candidates(std::size_t bucket) const {
    return workspace_.candidates.subspan(bucket * capacity_, workspace_.counts[bucket]);
  }

  void add(const Corner& corner) {
    const std::size_t bucket =
        kGrounds * grid_.cell_of(corner.x, corner.y) + static_cast<std::size_t>(ground_of(corner.label));
    std::uint8_t& count = workspace_.counts[bucket];
    Corner* first = &workspace_.candidates[bucket * capacity_];
    if (count == capacity_ && !is_better(corner, first[count - 1])) return;
    if (count < capacity_) ++count;
    Corner* place = first + count - 1;
    for (; place != first && is_better(corner, place[-1]); --place) *place = place[-1];
    *place = corner;
  }

  void drop_weak(float min_share_of_best) const {
    for (std::size_t bucket = 0; bucket < count(); ++bucket) {
      const std::span<const Corner> list = candidates(bucket);
      std::uint8_t& count = workspace_.counts[bucket];
      while (count > 1 && list[count - 1U].response < min_share_of_best * list[0].response) --count;
    }
  }

 private:
  CornerGrid grid_;
  std::size_t capacity_;
  CornerWorkspace& workspace_;
};

void fill_buckets(const CornerPicture& picture, const CornerGrid& grid, const CornerParams& params,
                  CornerWorkspace& workspace, CornerBuckets& buckets) {
  const ImageView<const std::uint8_t> gray = picture.gray;
  CornerResponse response(gray, workspace.response);
  std::array<float*, 3> rows = {workspace.responses[0].data(), workspace.responses[1].data(),
                                workspace.responses[2].data()};
  const auto width = static_cast<std::size_t>(gray.width);
  response.next_row({rows[1], width});
  response.next_row({rows[2], width});
  for (int y = CornerResponse::first_row() + 1; y + 1 < response.end_row(); ++y) {
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
    response.next_row({rows[2], width});
    const float* peaks = workspace.peaks.data();
    keep_peaks(rows[0], rows[1], rows[2], gray.width, params.min_response, workspace.peaks.data());
    for (int x = kCornerBorder; x < gray.width - kCornerBorder; ++x) {
      if (!(peaks[x] > 0.0F)) continue;
      if (!picture.hidden.empty() && picture.hidden[grid.cell_of(x, y)] != 0) continue;
      Corner corner{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), peaks[x]};
      if (is_burnt(gray, corner, params.burnt_level)) continue;
      if (find_label(picture, params.label_margin_px, corner)) buckets.add(corner);
    }
  }
}

}  // namespace

void find_corners(const CornerPicture& picture, const CornerParams& params, Random& random,
                  CornerWorkspace& workspace, BoundedList<Corner>& corners) {
  corners.clear();
  constexpr int kSmallest = 2 * (kCornerBorder + 1) + 1;
  if (picture.gray.width < kSmallest || picture.gray.height < kSmallest) return;
  const CornerGrid grid(picture.gray.width, picture.gray.height, params);
  CornerBuckets buckets(grid, params, workspace);
  fill_buckets(picture, grid, params, workspace, buckets);
  buckets.drop_weak(params.min_share_of_best);
  for (std::size_t round = 0; round < static_cast<std::size_t>(params.corners_per_bucket); ++round) {
    for (std::size_t bucket = 0; bucket < buckets.count() && !corners.full(); ++bucket) {
      const std::span<Corner> candidates = buckets.candidates(bucket);
      if (round >= candidates.size()) continue;
      const auto rest = static_cast<std::uint32_t>(candidates.size() - round);
      std::swap(candidates[round], candidates[round + random.below(rest)]);
      corners.push_back(candidates[round]);
    }
  }
}

}  // namespace traygauge
