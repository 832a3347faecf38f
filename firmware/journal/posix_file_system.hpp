// The disk as the kernel shows it.
#pragma once

#include "firmware/journal/file_system.hpp"

namespace traygauge {

// Has no state: one serves all.
FileSystem& posix_file_system();

}  // namespace traygauge
