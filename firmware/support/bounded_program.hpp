// Other programs, whose output is kept and who get little time.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace traygauge {

// What it wrote, both streams in one. Where it could not be started, was too slow or wrote too much, a last
// line in brackets says so.
std::string output_of(const std::vector<std::string>& arguments,
                      std::chrono::milliseconds limit = std::chrono::seconds(10));

}  // namespace traygauge
