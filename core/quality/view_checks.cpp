#include "core/quality/view_checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace traygauge {
namespace {

// Edges that reach out of the card are not its print's, but their profiles may.
ImageView<const std::uint8_t> around(ImageView<const std::uint8_t> picture, const PixelBox& box) {
  constexpr int kMargin_px = kEdgeReach_px + 2;
  const int left = std::max(box.left - kMargin_px, 0);
  const int top = std::max(box.top - kMargin_px, 0);
  const int right = std::min(box.right + kMargin_px, picture.width);
  const int bottom = std::min(box.bottom + kMargin_px, picture.height);
  return picture.sub(left, top, right - left, bottom - top);
}

bool is_blurred(const ViewQuality& quality, double limit_px, double limit_mm) {
  return quality.has_card && quality.card_edges.is_measured && quality.card_edges.sigma_px > limit_px &&
         quality.blur_mm() > limit_mm;
}

bool is_darker(const ViewQuality& quality, int white) {
  return quality.has_card && quality.card_edges.bright < white;
}

bool is_covered(const ViewQuality& quality, double limit) {
  return quality.has_card && quality.visible_card_fraction < limit;
}

double clipped_fraction(std::uint8_t label, const ViewQuality& first, const ViewQuality& second) {
  return std::max(first.items[label].clipped_fraction(), second.items[label].clipped_fraction());
}

double textured_fraction(std::uint8_t label, const ViewQuality& first, const ViewQuality& second,
                         int min_blocks) {
  double share = 1.0;
  for (const ViewQuality* view : {&first, &second}) {
    const ItemPixels& item = view->items[label];
    if (item.blocks >= static_cast<std::uint32_t>(std::max(min_blocks, 1))) {
      share = std::min(share, item.textured_fraction());
    }
  }
  return share;
}

void report_pictures(const ViewQuality& first, const ViewQuality& second, const ColourDifference& difference,
                     const ViewCheckParams& params, PictureReport& report) {
  report.blur_px = {first.card_edges.sigma_px, second.card_edges.sigma_px};
  report.visible_card_fraction = {first.visible_card_fraction, second.visible_card_fraction};
  report.card_white = {first.card_edges.bright, second.card_edges.bright};
  report.exposure_ratio = difference.exposure_ratio;
  report.white_balance_ratio = difference.white_balance_ratio;
  report.most_clipped_fraction = 0.0;
  report.least_textured_fraction = 1.0;
  for (int value = kFirstItemLabel; value <= kLastItemLabel; ++value) {
    const auto label = static_cast<std::uint8_t>(value);
    report.most_clipped_fraction =
        std::max(report.most_clipped_fraction, clipped_fraction(label, first, second));
    report.least_textured_fraction = std::min(
        report.least_textured_fraction, textured_fraction(label, first, second, params.min_texture_blocks));
  }
}

// Items are warned of one by one.
void warn_about_items(const ViewQuality& first, const ViewQuality& second, const ViewCheckParams& params,
                      WarningSet& warnings) {
  for (int value = kFirstItemLabel; value <= kLastItemLabel; ++value) {
    const auto label = static_cast<std::uint8_t>(value);
    warnings.raise_if(clipped_fraction(label, first, second) > params.clipped_warning, Warning::food_clipped,
                      label);
    warnings.raise_if(
        textured_fraction(label, first, second, params.min_texture_blocks) < params.textured_warning,
        Warning::little_texture, label);
  }
}

void warn_about_pictures(const ViewQuality& first, const ViewQuality& second, const ViewCheckParams& params,
                         const PictureReport& report, WarningSet& warnings) {
  const auto either = [&](auto is_doubtful) { return is_doubtful(first) || is_doubtful(second); };
  warnings.raise_if(either([&](const ViewQuality& view) {
                      return is_blurred(view, params.blur_warning_px, params.blur_warning_mm);
                    }),
                    Warning::blurred);
  warnings.raise_if(
      either([&](const ViewQuality& view) { return is_darker(view, params.underexposed_white); }),
      Warning::underexposed);
  warnings.raise_if(
      either([&](const ViewQuality& view) { return is_covered(view, params.visible_card_warning); }),
      Warning::card_partly_hidden);
  warnings.raise_if(report.exposure_ratio > params.exposure_ratio_warning, Warning::exposure_unequal);
  warnings.raise_if(report.white_balance_ratio > params.white_balance_ratio_warning,
                    Warning::white_balance_unequal);
}

Status judge_pair(const ColourDifference& difference, const ViewCheckParams& params) {
  if (difference.exposure_ratio > params.max_exposure_ratio) return StatusCode::exposure_differs;
  if (difference.white_balance_ratio > params.max_white_balance_ratio) {
    return StatusCode::white_balance_differs;
  }
  return StatusCode::ok;
}

}  // namespace

void assess_view(const CheckedView& view, const std::array<double, 2>& card_size_mm,
                 const ViewCheckParams& params, CardSilhouetteWorkspace& workspace, ViewQuality& quality) {
  const PixelBox& box = view.regions->card;
  quality.has_card = !box.empty();
  quality.card_edges = {};
  quality.card_silhouette = {};
  quality.card_px_per_mm = quality.visible_card_fraction = 0.0;
  if (quality.has_card) {
    quality.card_edges =
        measure_edge_blur(around(view.gray, box), around(view.labels, box), kCardLabel, params.edges);
    quality.card_px_per_mm =
        std::sqrt(view.regions->pixels[kCardLabel] / (card_size_mm[0] * card_size_mm[1]));
    quality.card_silhouette = measure_card_silhouette(view.labels, box, *view.lens, workspace);
    quality.visible_card_fraction =
        quality.card_silhouette.visible_fraction(card_size_mm[0] / card_size_mm[1]);
  }
  measure_item_pixels(view.gray, view.labels, view.regions->dish, params.item_pixels, quality.items);
  measure_region_colours(view.frame, view.labels, params.colours, quality.colours);
}

Status judge_view(const ViewQuality& quality, const ViewCheckParams& params) {
  if (is_darker(quality, params.min_white)) return StatusCode::frame_too_dark;
  if (is_covered(quality, params.min_visible_card)) return StatusCode::card_hidden;
  if (is_blurred(quality, params.max_blur_px, params.max_blur_mm)) return StatusCode::too_blurred;
  return StatusCode::ok;
}

StatusCode judge_item_pixels(std::uint8_t label, const ViewQuality& first, const ViewQuality& second,
                             const ViewCheckParams& params) {
  if (clipped_fraction(label, first, second) > params.max_clipped) return StatusCode::item_clipped;
  if (textured_fraction(label, first, second, params.min_texture_blocks) < params.min_textured) {
    return StatusCode::item_textureless;
  }
  return StatusCode::ok;
}

Status compare_pictures(const ViewQuality& first, const ViewQuality& second, const ViewCheckParams& params,
                        PictureReport& report, WarningSet& warnings) {
  const ColourDifference difference = compare_colours(first.colours, second.colours, params.colours);
  report_pictures(first, second, difference, params, report);
  warn_about_pictures(first, second, params, report, warnings);
  warn_about_items(first, second, params, warnings);
  return judge_pair(difference, params);
}

}  // namespace traygauge
