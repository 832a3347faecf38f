#include "core/paper/pipeline/dense_reconstruction.hpp"

#include "core/paper/stereo/disparity_range.hpp"
#include "core/paper/surface/depth_map.hpp"

namespace traygauge::paper {
namespace {

constexpr std::uint8_t kInRegion = 255;

// The region of interest: the dish, or the whole picture.
ImageView<std::uint8_t> mark_region(ImageView<const std::uint8_t> labels, bool dish_only,
                                    std::span<std::uint8_t> storage) {
  const ImageView<std::uint8_t> region{storage.data(), labels.width, labels.height};
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x)
      region.at(x, y) = !dish_only || is_on_dish(labels.at(x, y)) ? kInRegion : 0;
  }
  return region;
}

bool is_marked(ImageView<const std::uint8_t> region, const Vec2& pixel) {
  const int x = static_cast<int>(std::lround(pixel.x()));
  const int y = static_cast<int>(std::lround(pixel.y()));
  return region.contains(x, y) && region.at(x, y) != 0;
}

// Disparities of the sparse matches in the region (paper III-B-2, "Disparity range").
std::span<double> collect_match_disparities(const ReferencePair& pair,
                                            const PolarRectification& rectification,
                                            const std::array<ImageView<const std::uint8_t>, 2>& regions,
                                            std::span<double> storage) {
  std::size_t count = 0;
  for (const RayMatch& match : pair.matches) {
    const Vec2 first = pair.reference->cutout.camera.pixel(match.first);
    const Vec2 second = pair.other->cutout.camera.pixel(match.second);
    if (!is_marked(regions[0], first) || !is_marked(regions[1], second)) continue;
    Vec2 first_place;
    Vec2 second_place;
    if (!rectification.rectified(0, first, first_place) || !rectification.rectified(1, second, second_place))
      continue;
    storage[count++] = second_place.x() - first_place.x();
  }
  return storage.first(count);
}

}  // namespace

Status reconstruct_dense(const ReferencePair& pair, const Configuration& configuration,
                         DenseWorkspace& workspace, StageClock& clock, MeasurementReport& report,
                         WorkingPictures& pictures) {
  clock.enter(Stage::rectification);
  const std::array<const PreparedView*, 2> sides{pair.reference, pair.other};
  std::array<ImageView<const std::uint8_t>, 2> regions;
  for (std::size_t i = 0; i < 2; ++i)
    regions[i] =
        mark_region(sides[i]->working_labels, configuration.view.match_dish_only, workspace.regions[i]);
  PolarRectification rectification;
  const Status built = rectification.build(
      {pair.reference->cutout.camera, regions[0]}, {pair.other->cutout.camera, regions[1]},
      pair.other_from_reference, pair.matches, configuration.rectification, workspace.rectification);
  if (!built.ok()) return built;
  std::array<ImageView<std::uint8_t>, 2> gray;
  std::array<ImageView<std::uint8_t>, 2> masks;
  for (std::size_t i = 0; i < 2; ++i) {
    const int view = static_cast<int>(i);
    gray[i] = {workspace.rectified_gray[i].data(), rectification.columns(view), rectification.rows()};
    masks[i] = {workspace.rectified_region[i].data(), rectification.columns(view), rectification.rows()};
    rectification.rectify(view, sides[i]->gray, gray[i]);
    rectification.rectify_labels(view, regions[i], masks[i]);
    pictures.rectified[i] = gray[i];
  }
  report.rectified_rows = rectification.rows();
  report.rectified_columns = rectification.columns(0);

  clock.enter(Stage::stereo);
  const auto match_disparities =
      collect_match_disparities(pair, rectification, regions, workspace.match_disparities);
  Status status =
      estimate_disparity_range(match_disparities, configuration.disparity_range, report.disparity_range);
  if (!status.ok()) return status;
  const ImageView<Disparity> disparity{workspace.disparity.data(), gray[0].width, gray[0].height};
  status = match_dense(gray[0], masks[0], gray[1], masks[1], report.disparity_range, configuration.stereo,
                       workspace.stereo, disparity);
  if (!status.ok()) return status;
  pictures.disparity = disparity;

  clock.enter(Stage::surface);
  const ImageView<float> depth{workspace.depth_mm.data(), regions[0].width, regions[0].height};
  const auto correspondence = [&](const Vec2& first_pixel, Vec2& second_pixel) {
    Vec2 place;
    double disparity_px = 0.0;
    if (!rectification.rectified(0, first_pixel, place)) return false;
    if (!lookup_disparity(disparity, place.x(), place.y(), disparity_px)) return false;
    second_pixel = rectification.pixel(1, place.x() + disparity_px, place.y());
    return true;
  };
  const DepthMapReport filled =
      fill_depth_map(pair.reference->working_labels, pair.cameras(), correspondence, depth);
  report.matched_fraction = filled.known_fraction();
  pictures.depth_mm = depth;
  return filled.known_fraction() < configuration.view.min_matched_fraction ? StatusCode::too_little_depth
                                                                           : StatusCode::ok;
}

}  // namespace traygauge::paper
