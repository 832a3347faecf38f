// The parameters of whether both pictures show an item alike.
#pragma once

namespace traygauge {

struct PictureAgreementParams {
  int step = 3;          // every so many samples are looked at, in rows and columns
  double spot_mm = 3.5;  // over which colours are averaged: grains of food are seen at other places in each
  double difference = 40.0;  // of a colour, grey values; what is more is another thing or shine
  int min_samples = 20;      // then 15 % are three samples
  // Of 230 solid items of the captures, seed 61 and seed 91, in clean pairs, at most 0.125; the food under a
  // finger that moves its volume by more than 10 % 0.167 and more (tests/evaluation/experiments.md).
  double max_unlike = 0.15;
};

}  // namespace traygauge
