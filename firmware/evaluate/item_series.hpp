// The protocol's runs sorted by food item: what every figure of merit is computed from.
#pragma once

#include <string>
#include <vector>

#include "firmware/evaluate/protocol.hpp"

namespace traygauge {

// What an item's estimates are compared with.
enum class TruthVolume {
  above_bottom_plane,  // what a flat dish gives, as the paper assumes
  above_dish,          // above the dish's own inner surface; the closed volume of a scanned fruit
  column,              // under the upper surface of a scanned fruit
};

// One run's answer about one item.
struct Attempt {
  int pair = 0;            // index of the pair among the runs
  double angle_deg = 0.0;  // between the views: by truth, else as measured; NaN where neither is known
  bool is_measured = false;
  double volume_ml = 0.0;  // these hold only when is_measured
  double sigma_ml = 0.0;   // 0: not estimated, or the truth compared with is not what sigma speaks of
  bool is_warned = false;  // the run came with a warning
};

// One food item over all pairs and seeds.
struct ItemSeries {
  std::string capture;
  int label = 0;
  std::string name;
  bool overhangs = false;  // a scanned fruit: reported apart
  double truth_ml = 0.0;   // > 0
  std::vector<Attempt> attempts;
};

// A series for each item of `runs` that has that kind of truth: scanned fruit (`overhanging`), or everything
// else. Items whose true volume is 0 have no percentage error and are left out.
std::vector<ItemSeries> collect_series(const std::vector<PairRuns>& runs, TruthVolume truth,
                                       bool overhanging);

// The attempts at angles from `low_deg` up to, not including, `high_deg`; items without such are left out.
std::vector<ItemSeries> select_angles(const std::vector<ItemSeries>& items, double low_deg, double high_deg);

// The items of one capture.
std::vector<ItemSeries> select_capture(const std::vector<ItemSeries>& items, const std::string& capture);

// In per cent of the truth.
double signed_error_percent(double estimate_ml, double truth_ml);

}  // namespace traygauge
