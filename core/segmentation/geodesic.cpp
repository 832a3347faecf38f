#include "core/segmentation/geodesic.hpp"

#include <algorithm>
#include <limits>

#include "core/segmentation/neighbours.hpp"

namespace traygauge {
namespace {

constexpr std::int32_t kEnd = -1;
constexpr std::uint16_t kFar = std::numeric_limits<std::uint16_t>::max();

int cost_of(const CellColour& a, const CellColour& b, const GeodesicParams& params) {
  const int luma = a.luma - b.luma;
  const int red = a.red - b.red;
  const int green = a.green - b.green;
  const int squares = params.luma_weight * luma * luma + params.share_weight * (red * red + green * green);
  return std::min(params.step_cost + squares / 16, kMaxGeodesicStep);
}

}  // namespace

void spread_owners(ImageView<const CellColour> colours, const GeodesicParams& params,
                   GeodesicWorkspace& workspace, ImageView<std::uint8_t> owners) {
  const int width = owners.width;
  const int cells = width * owners.height;
  // A cell is listed once as a seed and once for each neighbour that shortens its way, at most.
  const auto cell_of = [&](std::int32_t entry) { return entry % cells; };
  workspace.heads.fill(kEnd);
  std::array<std::int32_t, kMaxGeodesicStep + 1>& heads = workspace.heads;
  std::fill_n(workspace.distance.begin(), cells, kFar);
  std::int32_t listed = 0;
  const auto list = [&](std::int32_t entry, int distance) {
    std::int32_t& head = heads[static_cast<std::size_t>(distance % (kMaxGeodesicStep + 1))];
    workspace.next[static_cast<std::size_t>(entry)] = head;
    head = entry;
    ++listed;
  };
  for (int cell = 0; cell < cells; ++cell) {
    const std::uint8_t owner = owners.data[cell];
    if (owner == kNoOwner || owner == kBarred) continue;
    workspace.distance[static_cast<std::size_t>(cell)] = 0;
    list(cell, 0);
  }
  for (int distance = 0; listed > 0 && distance < kFar - kMaxGeodesicStep; ++distance) {
    std::int32_t& head = heads[static_cast<std::size_t>(distance % (kMaxGeodesicStep + 1))];
    while (head != kEnd) {
      const std::int32_t entry = head;
      head = workspace.next[static_cast<std::size_t>(entry)];
      --listed;
      const int cell = cell_of(entry);
      if (workspace.distance[static_cast<std::size_t>(cell)] != distance) continue;
      for_each_neighbour(cell, width, cells, [&](int neighbour, std::size_t side) {
        if (owners.data[neighbour] == kBarred) return;
        const int reached = distance + cost_of(colours.data[cell], colours.data[neighbour], params);
        std::uint16_t& least = workspace.distance[static_cast<std::size_t>(neighbour)];
        if (reached >= least) return;
        least = static_cast<std::uint16_t>(reached);
        owners.data[neighbour] = owners.data[cell];
        list(neighbour + static_cast<std::int32_t>(side + 1) * cells, reached);
      });
    }
  }
}

}  // namespace traygauge
