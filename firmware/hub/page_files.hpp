// The page's files, where the hub finds them.
#pragma once

#include <filesystem>
#include <optional>

#include "firmware/base/expected.hpp"
#include "firmware/web/static_files.hpp"

namespace traygauge {

// Beside the program, in the checkout that it was built in, or where it was installed; none: only the API is
// served.
std::optional<std::filesystem::path> find_page_folder();

// Every file of the page at the root; Debian's three.js, which draws in 3-D, as three/three.module.js where
// it is installed: without it the page shows no 3-D.
Expected<void> read_page(const std::filesystem::path& folder, StaticFiles& files);

}  // namespace traygauge
