// Which labels a picture holds, for people.
#pragma once

#include <bitset>
#include <cstddef>
#include <string>

#include "simulator/capture/picture.hpp"

namespace traygauge {

// "2, 3, 200": those present that `is_listed` (std::size_t → bool) asks for.
template <class IsListed>
std::string list_labels(const Picture& labels, IsListed is_listed) {
  std::bitset<256> present;
  for (const std::uint8_t label : labels.pixels) present.set(label);
  std::string list;
  for (std::size_t label = 0; label < present.size(); ++label) {
    if (present.test(label) && is_listed(label)) list += (list.empty() ? "" : ", ") + std::to_string(label);
  }
  return list;
}

}  // namespace traygauge
