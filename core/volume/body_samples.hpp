// How thick a round body is over each sample of its picture.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/volume/outline_rows.hpp"

namespace traygauge {

// `bulge` of a sample is pq / (p + q), where p and q are the products of its distances from the outline
// along row and column. For a point x of an ellipse 1 − xᵀMx times a constant, which is the squared thickness
// of an ellipsoid; for one of a tube's picture ρ² − r², whichever way the tube lies and bends.
struct BodySample {
  int x = 0;
  int y = 0;
  Vec2 run = Vec2::Zero();  // of the line of sight
  double bulge_mm2 = 0.0;
  Vec2 gradient_mm = Vec2::Zero();  // of the bulge, on the level
};

class BodyPicture {
 public:
  // `view`'s samples of `label` in `outline`; `columns` is scratch, one for each column of the grid.
  BodyPicture(const SurfaceGrid& view, std::size_t index, const OutlineRows& outline, std::uint8_t label,
              double level_mm, std::span<OutlineChord> columns);

  double sample_mm2() const { return along_mm_.norm() * across_mm_.norm(); }

  // action(BodySample), row by row.
  template <class Action>
  void for_each_sample(Action&& action) const {
    const auto& labels = view_.labels;
    for (int x = 0; x < labels.width; ++x) columns_[static_cast<std::size_t>(x)] = {};
    const double step_mm = along_mm_.norm();
    const double row_step_mm = across_mm_.norm();
    BodySample sample;
    for (sample.y = 0; sample.y < labels.height; ++sample.y) {
      const int y = sample.y;
      const std::uint8_t* row = labels.row(y);
      const OutlineChord& chord = outline_.rows[static_cast<std::size_t>(y)].chords[index_];
      OutlineChord run;
      for (sample.x = chord.first; sample.x < chord.end; ++sample.x) {
        const int x = sample.x;
        if (row[x] != label_) continue;
        if (x >= run.end) {
          run = {x, x + 1};
          while (run.end < chord.end && row[run.end] == label_) ++run.end;
        }
        OutlineChord& column = columns_[static_cast<std::size_t>(x)];
        if (y >= column.end) {
          column = {y, y + 1};
          while (column.end < labels.height && labels.at(x, column.end) == label_) ++column.end;
        }
        const double left_mm = step_mm * (x + 0.5 - run.first);
        const double right_mm = step_mm * (run.end - x - 0.5);
        const double up_mm = row_step_mm * (y + 0.5 - column.first);
        const double down_mm = row_step_mm * (column.end - y - 0.5);
        const double p = left_mm * right_mm;
        const double q = up_mm * down_mm;
        sample.bulge_mm2 = p * q / (p + q);
        sample.gradient_mm = along_mm_ * ((right_mm - left_mm) * q / ((p + q) * step_mm)) +
                             across_mm_ * ((down_mm - up_mm) * p / ((p + q) * row_step_mm));
        sample.run = run_at(view_, x, y);
        action(sample);
      }
    }
  }

 private:
  SurfaceGrid view_;
  std::size_t index_;
  OutlineRows outline_;
  std::uint8_t label_;
  std::span<OutlineChord> columns_;
  Vec2 along_mm_ = Vec2(1.0, 0.0);  // from a sample to the next of its row, on the level
  Vec2 across_mm_ = Vec2(0.0, 1.0);
};

}  // namespace traygauge
