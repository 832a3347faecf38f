#include "core/paper/pipeline/feature_preparation.hpp"

#include <algorithm>
#include <cmath>

#include "core/paper/image/enlarge.hpp"
#include "core/paper/image/integral.hpp"

namespace traygauge::paper {
namespace {

// A scaled cut-out of the grey frame, in which points are looked for.
struct SearchPicture {
  ImageView<const std::uint8_t> gray;
  Vec2 scale = Vec2::Ones();   // of frame pixels to this picture's
  Vec2 corner = Vec2::Zero();  // its top left pixel in the frame
  int label = -1;              // only points on this label count; −1: all but those on the card

  Vec2 in_frame(const Vec2& pixel) const {
    return corner +
           Vec2(scale_coordinate(pixel.x(), 1.0 / scale.x()), scale_coordinate(pixel.y(), 1.0 / scale.y()));
  }
};

// The whole frame, reduced where the dish is larger than configured or the picture than the memory.
SearchPicture search_frame(const Configuration& configuration, PreparationWorkspace& workspace,
                           const PreparedView& view) {
  const ImageView<const std::uint8_t> gray = workspace.frame_gray;
  const double by_dish = std::sqrt(configuration.view.feature_dish_px / view.regions.dish_pixels);
  const double by_memory =
      std::sqrt(configuration.caps.max_feature_px / (static_cast<double>(gray.width) * gray.height));
  const double scale = std::min({1.0, by_dish, by_memory});
  const int width = std::max(1, static_cast<int>(gray.width * scale));
  const int height = std::max(1, static_cast<int>(gray.height * scale));
  SearchPicture picture{gray};
  if (width == gray.width && height == gray.height) return picture;
  const ImageView<std::uint8_t> reduced{workspace.feature_picture.data(), width, height};
  reduce_area(gray, reduced);
  picture.gray = reduced;
  picture.scale = {static_cast<double>(width) / gray.width, static_cast<double>(height) / gray.height};
  return picture;
}

// The card's box, enlarged so that the card has about the pattern's scale; false where it is not labelled.
bool search_card(const Configuration& configuration, PreparationWorkspace& workspace,
                 const PreparedView& view, SearchPicture& picture) {
  const PixelBox& box = view.regions.card;
  if (box.empty()) return false;
  const double card_mm2 = configuration.card.width_mm * configuration.card.height_mm;
  const double seen_px_per_mm = std::sqrt(view.regions.pixels[kCardLabel] / card_mm2);
  const double wanted =
      std::min(configuration.view.card_px_per_mm / seen_px_per_mm, configuration.view.max_card_enlargement);
  const double scale = fit_search_scale(wanted, box.width(), box.height(), configuration);
  if (scale <= 1.0) return false;
  const ImageView<const std::uint8_t> source =
      ImageView<const std::uint8_t>(workspace.frame_gray).sub(box.left, box.top, box.width(), box.height());
  const ImageView<std::uint8_t> enlarged{workspace.feature_picture.data(),
                                         static_cast<int>(box.width() * scale),
                                         static_cast<int>(box.height() * scale)};
  enlarge(source, enlarged);
  picture = {enlarged,
             {static_cast<double>(enlarged.width) / source.width,
              static_cast<double>(enlarged.height) / source.height},
             {static_cast<double>(box.left), static_cast<double>(box.top)},
             kCardLabel};
  return true;
}

std::uint8_t label_at(ImageView<const std::uint8_t> labels, const Vec2& pixel) {
  const int x = std::clamp(static_cast<int>(std::lround(pixel.x())), 0, labels.width - 1);
  const int y = std::clamp(static_cast<int>(std::lround(pixel.y())), 0, labels.height - 1);
  return labels.at(x, y);
}

// Appends the features of `picture` to the view's, at most `cap` of them.
void append_features(const SearchPicture& picture, bool card_apart, std::size_t cap,
                     const Configuration& configuration, PreparationWorkspace& workspace,
                     PreparedView& view) {
  const ImageView<std::uint32_t> integral{workspace.integral.data(), picture.gray.width + 1,
                                          picture.gray.height + 1};
  build_integral(picture.gray, integral);
  const std::size_t before = view.keypoints.size();
  const auto room = std::min(cap, view.keypoints.capacity() - before);
  BoundedList<Keypoint> found(view.keypoint_storage.subspan(before, room));
  detect_surf(integral, configuration.surf, workspace.surf, found);
  view.keypoints_found += found.size() + found.dropped();
  std::size_t kept = 0;
  for (const Keypoint& keypoint : found.items()) {
    const Vec2 pixel = picture.in_frame(keypoint.pixel);
    const bool on_card = label_at(view.labels, pixel) == kCardLabel;
    Vec2 ray;
    if (card_apart && on_card != (picture.label == kCardLabel)) continue;
    if (!view.lens.undistort_pixel(pixel, ray)) continue;
    view.ray_storage[before + kept] = ray;
    found[kept++] = keypoint;
  }
  describe_surf(integral, found.items().first(kept), view.descriptor_storage.subspan(before, kept));
  view.keypoints.extend(kept);
}

}  // namespace

double fit_search_scale(double wanted, int width, int height, const Configuration& configuration) {
  const FrameLimits& limits = configuration.limits;
  const double by_area = std::sqrt(configuration.caps.max_feature_px / (static_cast<double>(width) * height));
  return std::min({wanted, by_area, static_cast<double>(limits.max_frame_width) / width,
                   static_cast<double>(limits.max_frame_height) / height});
}

Status prepare_features(const Configuration& configuration, PreparationWorkspace& workspace,
                        PreparedView& view) {
  view.keypoints.clear();
  view.keypoints_found = 0;
  SearchPicture card;
  const bool card_apart = search_card(configuration, workspace, view, card);
  if (card_apart) {
    append_features(card, true, static_cast<std::size_t>(configuration.caps.max_card_keypoints),
                    configuration, workspace, view);
  }
  append_features(search_frame(configuration, workspace, view), card_apart, view.keypoints.capacity(),
                  configuration, workspace, view);
  return view.keypoints.size() < static_cast<std::size_t>(configuration.view.min_keypoints)
             ? StatusCode::too_few_features
             : StatusCode::ok;
}

}  // namespace traygauge::paper
