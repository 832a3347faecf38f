// What a picture in SVG holds.
#pragma once

#include <cstddef>
#include <string>

namespace traygauge {

// Why it is no well-formed XML with the root <svg>, as far as it uses elements, attributes, text and the five
// named entities; empty: it is.
std::string find_svg_fault(const std::string& document);

// How often `part` stands in what gnuplot draws for the plot's curve of that number, from 1. A curve with a
// title has one mark more, in the legend.
std::size_t count_in_curve(const std::string& document, int curve, const std::string& part);

}  // namespace traygauge
