// The demo's trays in pictures of half the size, for tests that measure them many times: in less than
// half of the time.
#pragma once

#include <filesystem>

#include "tests/support/temporary_folder.hpp"

namespace traygauge {

class SmallDemo {
 public:
  SmallDemo();
  std::filesystem::path folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

}  // namespace traygauge
