// Where captures lie on disk.
#pragma once

#include <filesystem>
#include <vector>

namespace traygauge {

// `folder` itself when it is a capture (holds capture.json), else the captures directly in it, sorted by
// name; empty when there are none or it cannot be read.
std::vector<std::filesystem::path> find_capture_folders(const std::filesystem::path& folder);

}  // namespace traygauge
