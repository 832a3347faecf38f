#include "firmware/segment/label_scores.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/labels/label_regions.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kLabels = 256;
constexpr double kMinOverlap = 0.25;

// Pixels by true label and label found.
class Overlaps {
 public:
  void add(const Picture& found, const Picture& truth) {
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
      ++pairs_[kLabels * truth.pixels[i] + found.pixels[i]];
      ++true_px_[truth.pixels[i]];
      ++found_px_[found.pixels[i]];
    }
  }
  double iou(std::size_t truth, std::size_t found) const {
    const double both = pairs_[kLabels * truth + found];
    const double either = true_px_[truth] + found_px_[found] - both;
    return either > 0.0 ? both / either : 0.0;
  }
  bool is_true(std::size_t label) const { return true_px_[label] > 0.0; }
  bool is_found(std::size_t label) const { return found_px_[label] > 0.0; }

 private:
  std::vector<double> pairs_ = std::vector<double>(kLabels * kLabels);
  std::array<double, kLabels> true_px_{};
  std::array<double, kLabels> found_px_{};
};

double food_iou(const Picture& found, const Picture& truth) {
  double both = 0.0;
  double either = 0.0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const bool is_found = is_item(found.pixels[i]);
    const bool is_true = is_item(truth.pixels[i]);
    both += is_found && is_true ? 1.0 : 0.0;
    either += is_found || is_true ? 1.0 : 0.0;
  }
  return either > 0.0 ? both / either : 1.0;
}

// Axes of the ellipse around a dish's own pixels, long one first; zero without enough of them.
cv::Size2f axes_of(const Picture& labels, int label) {
  std::vector<cv::Point> points;
  for (int y = 0; y < labels.size.height; ++y) {
    const std::uint8_t* row = labels.pixels.data() + static_cast<std::ptrdiff_t>(y) * labels.size.width;
    const std::uint8_t* end = row + labels.size.width;
    const std::uint8_t* first = std::find(row, end, label);
    if (first == end) continue;
    const std::uint8_t* last = end - 1;
    while (*last != label) --last;
    points.emplace_back(static_cast<int>(first - row), y);
    points.emplace_back(static_cast<int>(last - row), y);
  }
  constexpr std::size_t kMinPoints = 40;
  if (points.size() < kMinPoints) return {};
  std::vector<cv::Point> hull;
  cv::convexHull(points, hull);
  if (hull.size() < 5) return {};
  const cv::Size2f size = cv::fitEllipse(hull).size;
  return {std::max(size.width, size.height), std::min(size.width, size.height)};
}

double axes_error(const Picture& found, const Picture& truth, int label) {
  const cv::Size2f right = axes_of(truth, label);
  const cv::Size2f reached = axes_of(found, label);
  if (right.height <= 0.0F || reached.height <= 0.0F) return 1.0;
  return std::max(std::abs(static_cast<double>(reached.width / right.width) - 1.0),
                  std::abs(static_cast<double>(reached.height / right.height) - 1.0));
}

}  // namespace

double LabelScores::mean_item_iou() const {
  double sum = 0.0;
  for (const ItemScore& item : items) sum += item.iou;
  return items.empty() ? 1.0 : sum / static_cast<double>(items.size());
}

LabelScores score_labels(const Picture& found, const Picture& truth) {
  Overlaps overlaps;
  overlaps.add(found, truth);
  LabelScores scores;
  scores.food_iou = food_iou(found, truth);
  scores.card_iou = overlaps.iou(kCardLabel, kCardLabel);
  for (int label = kFirstItemLabel; label <= kLastItemLabel; ++label) {
    if (overlaps.is_found(static_cast<std::size_t>(label))) ++scores.items_found;
    if (!overlaps.is_true(static_cast<std::size_t>(label))) continue;
    ItemScore item{label, 0, 0.0};
    for (int other = kFirstItemLabel; other <= kLastItemLabel; ++other) {
      const double iou = overlaps.iou(static_cast<std::size_t>(label), static_cast<std::size_t>(other));
      if (iou > item.iou) item = {label, other, iou};
    }
    scores.items.push_back(item);
  }
  for (int label = kDishLabel; label <= kLastFurtherDishLabel; ++label) {
    if (!is_dish(static_cast<std::uint8_t>(label)) || !overlaps.is_true(static_cast<std::size_t>(label)))
      continue;
    scores.dishes.push_back({label, axes_error(found, truth, label)});
  }
  return scores;
}

std::array<std::uint8_t, 256> match_items(const std::array<Picture, 2>& found,
                                          const std::array<Picture, 2>& truth) {
  Overlaps overlaps;
  for (std::size_t v = 0; v < 2; ++v) overlaps.add(found[v], truth[v]);
  struct Candidate {
    double iou;
    int truth;
    int found;
  };
  std::vector<Candidate> candidates;
  for (int t = kFirstItemLabel; t <= kLastItemLabel; ++t) {
    for (int f = kFirstItemLabel; f <= kLastItemLabel; ++f) {
      const double iou = overlaps.iou(static_cast<std::size_t>(t), static_cast<std::size_t>(f));
      if (iou >= kMinOverlap) candidates.push_back({iou, t, f});
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    if (a.iou != b.iou) return a.iou > b.iou;
    return a.truth != b.truth ? a.truth < b.truth : a.found < b.found;
  });
  std::array<std::uint8_t, 256> meaning{};
  std::array<bool, 256> used{};
  for (const Candidate& candidate : candidates) {
    const auto t = static_cast<std::size_t>(candidate.truth);
    const auto f = static_cast<std::size_t>(candidate.found);
    if (used[t] || meaning[f] != 0) continue;
    used[t] = true;
    meaning[f] = static_cast<std::uint8_t>(candidate.truth);
  }
  return meaning;
}

}  // namespace traygauge
