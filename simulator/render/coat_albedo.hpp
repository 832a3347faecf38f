// How much light a coat mirrors in all directions together.
#pragma once

#include <cstddef>

namespace traygauge {

// Of a coat that mirrors the share `coat` at normal incidence, of GGX roughness `alpha` from 0.01 to 1. From
// a table, within about 0.002.
class CoatAlbedo {
 public:
  CoatAlbedo(float coat, float alpha);

  // For light from, or to, a direction at this cosine to the normal.
  float at(float cosine) const;
  // Of light that arrives evenly from all directions.
  float mean() const { return mean_; }

 private:
  float coat_;
  std::size_t row_;  // of the table, and how far on the way to the next
  float row_fraction_;
  float mean_;
};

}  // namespace traygauge
