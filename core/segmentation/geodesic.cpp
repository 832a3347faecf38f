#include "core/segmentation/geodesic.hpp"

#include <algorithm>
#include <limits>

#include "core/segmentation/neighbours.hpp"

namespace traygauge {
namespace {

constexpr std::int32_t kEnd = -1;  // no cell's index
constexpr std::uint16_t kFar = std::numeric_limits<std::uint16_t>::max();

// Cells by the distance at which they are to be visited, last come first; no two in use lie further apart
// than there are lists.
class DistanceBuckets {
 public:
  explicit DistanceBuckets(GeodesicWorkspace& workspace) : workspace_(workspace) {
    workspace_.heads.fill(kEnd);
  }

  bool empty() const { return listed_ == 0; }

  void add(std::int32_t cell, int distance) {
    std::int32_t& head = head_of(distance);
    next(cell) = head;
    previous(cell) = kEnd;
    if (head != kEnd) previous(head) = cell;
    head = cell;
    ++listed_;
  }
  void remove(std::int32_t cell, int distance) {
    if (previous(cell) == kEnd) {
      head_of(distance) = next(cell);
    } else {
      next(previous(cell)) = next(cell);
    }
    if (next(cell) != kEnd) previous(next(cell)) = previous(cell);
    --listed_;
  }
  // kEnd where there is none left at this distance.
  std::int32_t take(int distance) {
    const std::int32_t cell = head_of(distance);
    if (cell != kEnd) remove(cell, distance);
    return cell;
  }

 private:
  std::int32_t& head_of(int distance) {
    return workspace_.heads[static_cast<std::size_t>(distance % (kMaxGeodesicStep + 1))];
  }
  std::int32_t& next(std::int32_t cell) const { return workspace_.next[static_cast<std::size_t>(cell)]; }
  std::int32_t& previous(std::int32_t cell) const {
    return workspace_.previous[static_cast<std::size_t>(cell)];
  }

  GeodesicWorkspace& workspace_;
  int listed_ = 0;
};

}  // namespace

int geodesic_step(const CellColour& a, const CellColour& b) {
  const int luma = a.luma - b.luma;
  const int red = a.red - b.red;
  const int green = a.green - b.green;
  const int squares = luma * luma + 4 * (red * red + green * green);
  return std::min(1 + squares / 16, kMaxGeodesicStep);
}

void spread_owners(ImageView<const CellColour> colours, GeodesicWorkspace& workspace,
                   ImageView<std::uint8_t> owners) {
  const int width = owners.width;
  const int cells = width * owners.height;
  DistanceBuckets buckets(workspace);
  std::fill_n(workspace.distance.begin(), cells, kFar);
  for (int cell = 0; cell < cells; ++cell) {
    const std::uint8_t owner = owners.data[cell];
    if (owner == kNoOwner || owner == kBarred) continue;
    workspace.distance[static_cast<std::size_t>(cell)] = 0;
    buckets.add(cell, 0);
  }
  for (int distance = 0; !buckets.empty() && distance < kFar - kMaxGeodesicStep; ++distance) {
    for (std::int32_t cell = buckets.take(distance); cell != kEnd; cell = buckets.take(distance)) {
      for_each_neighbour(cell, width, cells, [&](int neighbour) {
        std::uint16_t& least = workspace.distance[static_cast<std::size_t>(neighbour)];
        if (least <= distance + 1 || owners.data[neighbour] == kBarred) return;
        const int reached = distance + geodesic_step(colours.data[cell], colours.data[neighbour]);
        if (reached >= least) return;
        if (least != kFar) buckets.remove(neighbour, least);
        least = static_cast<std::uint16_t>(reached);
        owners.data[neighbour] = owners.data[cell];
        buckets.add(neighbour, reached);
      });
    }
  }
}

}  // namespace traygauge
