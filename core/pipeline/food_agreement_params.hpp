// When the food's outlines of both views belong to the same scene.
#pragma once

namespace traygauge {

struct FoodAgreementParams {
  // Share of food samples whose place in the other view carries the same label: below, outlines are of
  // another picture, or something moved between the views. Exact outlines reach 0.97 and more.
  double min_fraction = 0.85;
  int step = 3;  // every so many samples are looked at, in rows and columns
};

}  // namespace traygauge
