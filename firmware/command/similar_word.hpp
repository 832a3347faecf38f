// What somebody may have meant who mistyped a word.
#pragma once

#include <span>
#include <string>

namespace traygauge {

// The word of `known` that `typed` is nearest to, by letters that are wrong, missing, too many or exchanged,
// or that it begins; empty where none is near.
std::string find_similar(const std::string& typed, std::span<const std::string> known);

}  // namespace traygauge
