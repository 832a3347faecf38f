// Where a text stops being JSON, for who has to correct it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace traygauge {

struct JsonFlaw {
  int line = 1;       // from 1
  int column = 1;     // from 1, in characters
  std::string found;  // what stands there
  std::string hint;
};

// `byte`: how many bytes the parser had read when it stopped.
JsonFlaw describe_json_flaw(std::string_view text, std::size_t byte);
// The first number that is too large for a double.
JsonFlaw describe_number_overflow(std::string_view text);

}  // namespace traygauge
