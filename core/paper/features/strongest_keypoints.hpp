// The strongest of many keypoints, in an order that no equal responses can disturb.
#pragma once

#include <algorithm>

#include "core/base/bounded_list.hpp"
#include "core/paper/features/keypoint.hpp"

namespace traygauge::paper {

// A strict order: response, then position from the top left, then scale.
inline bool is_stronger(const Keypoint& a, const Keypoint& b) {
  if (a.response != b.response) return a.response > b.response;
  if (a.pixel.y() != b.pixel.y()) return a.pixel.y() < b.pixel.y();
  if (a.pixel.x() != b.pixel.x()) return a.pixel.x() < b.pixel.x();
  return a.scale_px < b.scale_px;
}

// Adds to a list that is full at some point and then replaces its weakest, which lies on top of a heap.
class StrongestKeypoints {
 public:
  explicit StrongestKeypoints(BoundedList<Keypoint>& list) : list_(list) { list_.clear(); }

  void add(const Keypoint& keypoint) {
    if (!list_.full()) {
      list_.push_back(keypoint);
      if (list_.full()) std::make_heap(list_.begin(), list_.end(), is_stronger);
      return;
    }
    Keypoint loser = keypoint;
    if (!list_.empty() && is_stronger(keypoint, list_[0])) {
      std::pop_heap(list_.begin(), list_.end(), is_stronger);
      Keypoint& weakest = list_[list_.size() - 1];
      loser = weakest;
      weakest = keypoint;
      std::push_heap(list_.begin(), list_.end(), is_stronger);
    }
    list_.push_back(loser);  // counted as dropped
  }

  // Strongest first.
  void sort() {
    if (!list_.full()) std::make_heap(list_.begin(), list_.end(), is_stronger);
    std::sort_heap(list_.begin(), list_.end(), is_stronger);
  }

 private:
  BoundedList<Keypoint>& list_;
};

}  // namespace traygauge::paper
