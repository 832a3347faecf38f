#include "simulator/capture/label_specks.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/labels/label_regions.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kSpeckPixels = 64;  // the smallest item that is measured
constexpr int kCoreSide = 3;
constexpr int kNearPx = 8;  // an item seen through a gap shows its next part within this distance
// Exact outlines of the recorded captures leave at most 4 specks of foods and dishes (and up to 23 of dish 1,
// between foods, which are not counted); a smoothed outline leaves one for every few pixels of its length.
constexpr std::size_t kMaxSpecks = 100;
constexpr std::size_t kMaxThinLabels = 8;
constexpr std::size_t kShownLabels = 8;

// Equal labels in a row; `parent` leads to the first run of the connected part.
struct Run {
  int y = 0;
  int left = 0;
  int right = 0;  // behind the last
  std::uint8_t label = 0;
  std::size_t parent = 0;
};

// What is known of a connected part, kept with its first run.
struct Part {
  std::size_t pixels = 0;
  bool has_core = false;
};

int overlap_of(const Run& a, const Run& b) {
  return std::min(a.right, b.right) - std::max(a.left, b.left);
}

// The connected parts of all labels but the background, in runs.
class LabelParts {
 public:
  explicit LabelParts(const Picture& labels) {
    for (int y = 0; y < labels.size.height; ++y) {
      rows_.push_back(runs_.size());
      add_row(labels, y);
    }
    rows_.push_back(runs_.size());
    for (int y = 1; y < labels.size.height; ++y) join_row(y);
    for (Run& run : runs_) run.parent = runs_[run.parent].parent;  // which lies before it, and knows its root
    parts_.resize(runs_.size());
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      parts_[root(i)].pixels += static_cast<std::size_t>(runs_[i].right - runs_[i].left);
    }
    for (int y = 2; y < labels.size.height; ++y) find_cores(y);
  }

  const std::vector<Run>& runs() const { return runs_; }
  std::size_t root(std::size_t i) const { return runs_[i].parent; }
  bool is_speck(std::size_t part) const {
    return !parts_[part].has_core && parts_[part].pixels < kSpeckPixels;
  }
  const Part& part(std::size_t i) const { return parts_[i]; }

 private:
  void add_row(const Picture& labels, int y) {
    const std::uint8_t* row = labels.gray().row(y);
    for (int left = 0; left < labels.size.width;) {
      int right = left + 1;
      while (right < labels.size.width && row[right] == row[left]) ++right;
      if (row[left] != 0) runs_.push_back({y, left, right, row[left], runs_.size()});
      left = right;
    }
  }

  // Calls `visit` with each run above run `i` that has its label and touches it.
  template <class Visit>
  void visit_above(std::size_t i, Visit visit) const {
    const Run& run = runs_[i];
    const auto row = static_cast<std::size_t>(run.y);
    const auto begin = runs_.begin() + static_cast<std::ptrdiff_t>(rows_[row - 1]);
    const auto end = runs_.begin() + static_cast<std::ptrdiff_t>(rows_[row]);
    auto above = std::upper_bound(begin, end, run.left, [](int x, const Run& r) { return x < r.right; });
    for (; above != end && above->left < run.right; ++above) {
      if (above->label == run.label) visit(static_cast<std::size_t>(above - runs_.begin()));
    }
  }

  void join_row(int y) {
    const auto row = static_cast<std::size_t>(y);
    for (std::size_t i = rows_[row]; i < rows_[row + 1]; ++i) {
      visit_above(i, [&](std::size_t above) { join(i, above); });
    }
  }

  // While parts are still joined; keeps the ways short.
  std::size_t find_root(std::size_t i) {
    while (runs_[i].parent != i) {
      runs_[i].parent = runs_[runs_[i].parent].parent;
      i = runs_[i].parent;
    }
    return i;
  }

  void join(std::size_t a, std::size_t b) {
    const std::size_t first = find_root(a);
    const std::size_t second = find_root(b);
    runs_[std::max(first, second)].parent = std::min(first, second);
  }

  void find_cores(int y) {
    const auto row = static_cast<std::size_t>(y);
    for (std::size_t i = rows_[row]; i < rows_[row + 1]; ++i) {
      visit_above(i, [&](std::size_t above) {
        if (overlap_of(runs_[i], runs_[above]) < kCoreSide) return;
        visit_above(above, [&](std::size_t top) {
          const int left = std::max({runs_[i].left, runs_[above].left, runs_[top].left});
          const int right = std::min({runs_[i].right, runs_[above].right, runs_[top].right});
          if (right - left >= kCoreSide) parts_[root(i)].has_core = true;
        });
      });
    }
  }

  std::vector<Run> runs_;
  std::vector<std::size_t> rows_;  // index of each row's first run, and of the end
  std::vector<Part> parts_;        // valid at roots
};

// One speck with its runs, from top to bottom.
struct Speck {
  std::uint8_t label = 0;
  std::size_t pixels = 0;
  std::vector<Run> runs;
};

std::vector<Speck> list_specks(const LabelParts& parts) {
  std::vector<Speck> specks;
  std::vector<std::size_t> index(parts.runs().size());
  for (std::size_t i = 0; i < parts.runs().size(); ++i) {
    const std::size_t root = parts.root(i);
    if (!parts.is_speck(root)) continue;
    if (root == i) {
      index[root] = specks.size();
      specks.push_back({parts.runs()[i].label, parts.part(i).pixels, {}});
    }
    specks[index[root]].runs.push_back(parts.runs()[i]);
  }
  return specks;
}

// Labels that are somewhere 3 × 3 pixels wide.
std::bitset<256> list_wide_labels(const LabelParts& parts) {
  std::bitset<256> wide;
  for (std::size_t i = 0; i < parts.runs().size(); ++i) {
    if (parts.part(parts.root(i)).has_core) wide.set(parts.runs()[i].label);
  }
  return wide;
}

// Labels of as many pixels as an item has.
std::bitset<256> list_large_labels(const Picture& labels) {
  std::array<std::size_t, 256> pixels{};
  for (const std::uint8_t label : labels.pixels) ++pixels.at(label);
  std::bitset<256> large;
  for (std::size_t label = 0; label < pixels.size(); ++label) {
    large.set(label, pixels.at(label) >= kSpeckPixels);
  }
  return large;
}

// Whether a pixel's label lies between those on its two sides in a row or column, as where an edge was
// smoothed.
class SoftEdges {
 public:
  SoftEdges(const Picture& labels, const std::bitset<256>& wide) : labels_(labels), wide_(wide) {}

  bool contain(int x, int y) const { return is_between(x, y, 1, 0) || is_between(x, y, 0, 1); }

 private:
  // The nearest label of some width from a place on; the place's own where there is none near.
  std::uint8_t side(int x, int y, int step_x, int step_y) const {
    constexpr int reach_px = 4;
    const ImageView<const std::uint8_t> pixels = labels_.gray();
    for (int i = 1; i <= reach_px; ++i) {
      const int u = x + i * step_x;
      const int v = y + i * step_y;
      if (!pixels.contains(u, v)) break;
      if (pixels.at(u, v) == 0 || wide_.test(pixels.at(u, v))) return pixels.at(u, v);
    }
    return pixels.at(x, y);
  }
  bool is_between(int x, int y, int step_x, int step_y) const {
    const std::uint8_t label = labels_.gray().at(x, y);
    const std::uint8_t before = side(x, y, -step_x, -step_y);
    const std::uint8_t behind = side(x, y, step_x, step_y);
    return std::min(before, behind) < label && label < std::max(before, behind);
  }

  const Picture& labels_;
  const std::bitset<256>& wide_;
};

// Pixels of labels that are nowhere wide, on soft edges.
std::size_t count_soft_pixels(const LabelParts& parts, const Picture& labels, const std::bitset<256>& wide) {
  const SoftEdges edges(labels, wide);
  std::size_t count = 0;
  for (const Run& run : parts.runs()) {
    if (wide.test(run.label)) continue;
    for (int x = run.left; x < run.right; ++x) {
      if (edges.contain(x, run.y)) ++count;
    }
  }
  return count;
}

// "2, 3, 5 and 60 more".
std::string list_of(const std::bitset<256>& labels) {
  std::string list;
  std::size_t shown = 0;
  for (std::size_t label = 0; label < labels.size(); ++label) {
    if (!labels.test(label)) continue;
    if (shown == kShownLabels) return list + " and " + std::to_string(labels.count() - shown) + " more";
    list += (shown == 0 ? "" : ", ") + std::to_string(label);
    ++shown;
  }
  return list;
}

std::string count_of(std::size_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

// True where the picture has the speck's label near, but for the speck itself; or where a dish's speck
// touches anything but background: this is the dish between foods.
bool belongs_somewhere(const Speck& speck, const Picture& labels) {
  const ImageView<const std::uint8_t> pixels = labels.gray();
  std::size_t near_pixels = 0;
  int left = labels.size.width;
  int right = 0;
  for (const Run& run : speck.runs) {
    left = std::min(left, run.left);
    right = std::max(right, run.right);
  }
  const int top = speck.runs.front().y;
  const int bottom = speck.runs.back().y + 1;
  for (int y = std::max(top - kNearPx, 0); y < std::min(bottom + kNearPx, labels.size.height); ++y) {
    for (int x = std::max(left - kNearPx, 0); x < std::min(right + kNearPx, labels.size.width); ++x) {
      const std::uint8_t label = pixels.at(x, y);
      if (label == speck.label) ++near_pixels;
      const bool touches = y >= top - 1 && y <= bottom && x >= left - 1 && x <= right;
      const bool is_other = label != speck.label && label != kBackgroundLabel && label != kCardLabel;
      if (is_dish(speck.label) && touches && is_other) return true;
    }
  }
  return near_pixels > speck.pixels;
}

void paint_over(const Speck& speck, Picture& labels) {
  for (const Run& run : speck.runs) {
    const std::size_t row = static_cast<std::size_t>(run.y) * static_cast<std::size_t>(labels.size.width);
    std::uint8_t beside = 0;
    if (run.left > 0) {
      beside = labels.pixels[row + static_cast<std::size_t>(run.left) - 1];
    } else if (run.right < labels.size.width) {
      beside = labels.pixels[row + static_cast<std::size_t>(run.right)];
    }
    std::fill_n(labels.pixels.begin() + static_cast<std::ptrdiff_t>(row) + run.left, run.right - run.left,
                beside);
  }
}

void refuse_soft_edges(const InputFile& file, const Picture& labels, const LabelParts& parts,
                       const std::vector<Speck>& specks, const std::bitset<256>& wide) {
  std::bitset<256> thin;
  std::size_t count = 0;
  std::size_t pixels = 0;
  for (const Run& run : parts.runs()) thin.set(run.label, !wide.test(run.label));
  for (const Speck& speck : specks) {
    if (speck.label == kDishLabel) continue;
    ++count;
    pixels += speck.pixels;
  }
  const std::size_t soft_pixels = count_soft_pixels(parts, labels, wide);
  if (count < kMaxSpecks && thin.count() <= kMaxThinLabels && soft_pixels < kSpeckPixels) return;
  std::string found = count_of(count, "speck") + " (" + count_of(pixels, "pixel") + ")";
  if (thin.any()) found += ", and nowhere wider the labels " + list_of(thin);
  throw InputError(file, "labels with sharp edges", found,
                   "the edges were smoothed, or the picture was JPEG once: export the labels again, as PNG, "
                   "without smoothing");
}

// Before memory is taken for each run of equal labels.
void refuse_noise(const InputFile& file, const Picture& labels) {
  constexpr std::size_t max_changes = std::size_t{1} << 22U;  // sharp outlines have a few in each row
  std::size_t changes = 0;
  for (std::size_t i = 1; i < labels.pixels.size(); ++i) {
    if (labels.pixels[i] != labels.pixels[i - 1]) ++changes;
  }
  if (changes <= max_changes) return;
  throw InputError(file, "labels with sharp edges", count_of(changes, "change") + " of label along the rows",
                   "this is no label picture, or it was JPEG once: export the labels again, as PNG");
}

}  // namespace

void ignore_specks(const InputFile& file, Picture& labels, std::vector<InputWarning>& warnings) {
  refuse_noise(file, labels);
  const LabelParts parts(labels);
  const std::vector<Speck> specks = list_specks(parts);
  const std::bitset<256> wide = list_wide_labels(parts);
  refuse_soft_edges(file, labels, parts, specks, wide);
  const std::bitset<256> large = list_large_labels(labels);
  std::bitset<256> ignored;
  std::size_t pixels = 0;
  for (const Speck& speck : specks) {
    const bool is_item = wide.test(speck.label) || large.test(speck.label);
    if (is_item && belongs_somewhere(speck, labels)) continue;
    ignored.set(speck.label);
    pixels += speck.pixels;
    paint_over(speck, labels);
  }
  if (ignored.none()) return;
  warnings.push_back({"labels_specks", printable(file.path.string()) + ": specks of " +
                                           (ignored.count() == 1 ? "label " : "labels ") + list_of(ignored) +
                                           " (" + count_of(pixels, "pixel") + ") are ignored."});
}

}  // namespace traygauge
