// What a network makes of a picture, drawn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "core/network/network_input.hpp"
#include "core/network/network_runner.hpp"

namespace traygauge {

// The class of each cell: the one whose channel is largest, the first of equal ones.
cv::Mat1b classes_of(const TensorView& classes);

// Of blue, green and red; class 0 is grey.
cv::Vec3b class_colour(std::size_t class_index);

// How many cells of each class lie where the frame does, of `place` in a picture as wide as `input_width`.
std::vector<std::size_t> count_classes(const cv::Mat1b& classes, std::size_t class_count,
                                       const InputPlacement& place, int input_width);

// Beside each other in panels of the network's size: the picture, classes, and, where the network has them,
// borders (white where they are likely) and the first three numbers of the embedding as colours.
cv::Mat3b draw_network_sheet(const cv::Mat3b& picture, const NetworkRunner& runner);

}  // namespace traygauge
