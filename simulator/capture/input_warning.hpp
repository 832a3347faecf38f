// What a person is told about an input that is used although something about it is doubtful.
#pragma once

#include <string>

namespace traygauge {

struct InputWarning {
  std::string code;     // e.g. "labels_specks"
  std::string message;  // a sentence that names the file
};

}  // namespace traygauge
