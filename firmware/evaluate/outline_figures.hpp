// How well the outlines that the segmentation drew agree with the given ones.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "firmware/segment/label_scores.hpp"

namespace traygauge {

struct PairRuns;

// Of one pair: what was drawn in both views, and how long it took.
struct PairOutlines {
  std::string status;
  std::array<LabelScores, 2> views;
  double time_ms = 0.0;
};

// Undefined (NaN) where nothing of the kind was to be found.
struct OutlineFigures {
  std::string capture;
  int pairs = 0;
  double food_iou = 0.0;             // mean over views
  double item_iou = 0.0;             // mean over items and views, best each
  double card_iou = 0.0;             // mean over views
  double axes_error_percent = 0.0;   // median over dishes and views, the larger of both axes
  double right_count_percent = 0.0;  // of views
  double all_food_percent = 0.0;     // mean absolute error of all food of a pair together
  double time_ms = 0.0;              // median
};

// A row a capture, and last one for all; empty where nothing was drawn.
std::vector<OutlineFigures> summarise_outlines(const std::vector<PairRuns>& runs);

std::string compose_outline_table(const std::vector<OutlineFigures>& figures);

// A row an item or dish of each view.
std::string compose_outlines_csv(const std::vector<PairRuns>& runs);

}  // namespace traygauge
