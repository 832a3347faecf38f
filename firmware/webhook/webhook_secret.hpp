// The files that a webhook needs.
#pragma once

#include <filesystem>
#include <string>

#include "firmware/base/expected.hpp"

namespace traygauge {

// 20 to 128 visible characters in one line; the file has to be readable by the hub alone. The failure names
// the file, never what stands there.
Expected<std::string> read_webhook_secret(const std::filesystem::path& file);

// Whether it has at least one certificate in PEM.
Expected<void> check_certificates(const std::filesystem::path& file);

}  // namespace traygauge
