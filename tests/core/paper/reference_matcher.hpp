// Dense matching once more, pixel by pixel and by definition: what the blocks, lanes, rings and running sums
// of core/stereo must equal bit for bit.
#pragma once

#include "tests/core/paper/stereo_scene.hpp"

namespace traygauge::test {

cv::Mat_<Disparity> match_by_definition(const TestPair& pair, DisparityRange range,
                                        const paper::StereoParams& params);

}  // namespace traygauge::test
