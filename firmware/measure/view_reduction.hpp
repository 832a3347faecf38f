// Pictures with more pixels than the measurement was made for, at a whole part of their size.
#pragma once

#include "simulator/capture/capture.hpp"

namespace traygauge {

// Up to this side, what is told apart in a picture (the card's print, a rim, the grain of a food) is as large
// in pixels as the stages expect. Of 4000 x 3000 the card's edges are too soft, and a rim has more sides than
// are kept.
inline constexpr int kMaxMeasuredSide = 3264;

// 1: as it is; 2: half its sides; and so on.
int reduction_of(PictureSize size);

// Reduces a view where it is larger; the camera of what is left.
CameraDescription reduce_where_larger(LoadedView& view, const CameraDescription& camera);

// Each pixel is the mean of factor x factor, each label the most frequent among them; rows and columns that
// are left over at the right and below are dropped.
void reduce_view(LoadedView& view, int factor);
// The camera of such pictures.
CameraDescription reduced(const CameraDescription& camera, int factor);

}  // namespace traygauge
