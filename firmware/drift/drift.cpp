#include "firmware/drift/drift.hpp"

#include <cmath>

#include "firmware/base/text.hpp"

namespace traygauge {
namespace {

// By more than their errors.
bool do_differ(const MedianEstimate& last, const MedianEstimate& first, const DriftParams& params) {
  return first.count >= params.min_values &&
         std::abs(last.value - first.value) > params.sigmas * std::hypot(last.sigma, first.sigma);
}

bool is_too_blurred(const MedianEstimate& last, const std::optional<MedianEstimate>& first,
                    const DriftParams& params) {
  return first && do_differ(last, *first, params) && last.value > params.max_blur_ratio * first->value;
}

bool is_beyond(const MedianEstimate& last, double limit, const DriftParams& params) {
  return std::abs(last.value) > limit && std::abs(last.value) > params.sigmas * last.sigma;
}

// What came nearer to zero was mended.
bool is_changed(const MedianEstimate& last, const std::optional<MedianEstimate>& first, double limit,
                const DriftParams& params) {
  return first && do_differ(last, *first, params) && std::abs(last.value - first->value) > limit &&
         is_beyond(last, limit, params);
}

bool is_drift(WatchedCheck check, const MedianEstimate& last, const std::optional<MedianEstimate>& first,
              const DriftParams& params) {
  if (last.count < params.min_values) return false;
  switch (check) {
    case WatchedCheck::scale_percent:
      return is_beyond(last, params.max_scale_percent, params) ||
             is_changed(last, first, params.max_scale_change_percent, params);
    case WatchedCheck::dish_height_mm:
      return is_beyond(last, params.max_dish_height_mm, params) ||
             is_changed(last, first, params.max_dish_height_change_mm, params);
    case WatchedCheck::glaze_height_mm:
      return is_beyond(last, params.max_glaze_height_mm, params);
    case WatchedCheck::blur_px:
      break;
  }
  return is_too_blurred(last, first, params);
}

// "0.42 % larger"
std::string scale_against(double percent) {
  return fixed(std::abs(percent), 2) + " % " + (percent > 0.0 ? "larger" : "smaller");
}

// "0.31 mm above"
std::string height_beside(double mm) {
  return fixed(std::abs(mm), 2) + " mm " + (mm > 0.0 ? "above" : "below");
}

// ", after 0.31 mm above in the first 50 that are stored"
std::string after_first(const std::optional<MedianEstimate>& first, std::string (*words)(double)) {
  if (!first) return "";
  return ", after " + words(first->value) + " in the first " + std::to_string(first->count) +
         " that are stored";
}

std::string scale_sentence(const MedianEstimate& last, const std::optional<MedianEstimate>& first) {
  return "the card made everything " + scale_against(last.value) + " than the dishes say (± " +
         fixed(last.sigma, 2) + " %)" + after_first(first, scale_against) +
         ". Measure the card with a caliper, and look whether it is worn or another lies there.";
}

// "0.31 mm above where the card puts them (± 0.04 mm)"
std::string height_against(const MedianEstimate& last, const char* ruler) {
  return height_beside(last.value) + " where " + ruler + " (± " + fixed(last.sigma, 2) + " mm)";
}

std::string height_sentence(const MedianEstimate& last, const std::optional<MedianEstimate>& first) {
  return "the edges of the dishes came out " + height_against(last, "the card puts them") +
         after_first(first, height_beside) +
         ". Look whether the card lies flat on what the dishes stand on, and measure its thickness.";
}

std::string glaze_sentence(const MedianEstimate& last) {
  return "bare glaze inside of the dishes came out " + height_against(last, "their descriptions put it") +
         ". Look whether they are the dishes that are described, and learn those in use anew with "
         "traygauge enrol-dish.";
}

std::string blur_sentence(const MedianEstimate& last, const MedianEstimate& first) {
  return "the pictures were " + fixed(last.value / first.value, 2) + " times as blurred as in the first " +
         std::to_string(first.count) + " that are stored: " + fixed(last.value, 2) + " px (± " +
         fixed(last.sigma, 2) + " px), then " + fixed(first.value, 2) +
         " px. Clean the lens, and look whether its focus or the camera was moved.";
}

}  // namespace

CheckTrend judge_trend(WatchedCheck check, const MedianEstimate& last,
                       const std::optional<MedianEstimate>& first, const DriftParams& params) {
  return {check, last, first, is_drift(check, last, first, params)};
}

std::string drift_sentence(const CheckTrend& trend) {
  const std::string begin = "In the last " + std::to_string(trend.last.count) + " trays ";
  switch (trend.check) {
    case WatchedCheck::scale_percent:
      return begin + scale_sentence(trend.last, trend.first);
    case WatchedCheck::dish_height_mm:
      return begin + height_sentence(trend.last, trend.first);
    case WatchedCheck::glaze_height_mm:
      return begin + glaze_sentence(trend.last);
    case WatchedCheck::blur_px:
      break;
  }
  return begin + blur_sentence(trend.last, trend.first.value_or(trend.last));
}

}  // namespace traygauge
