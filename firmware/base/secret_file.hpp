// Files that hold secrets.
#pragma once

#include <string>

#include "firmware/base/expected.hpp"

namespace traygauge {

// All of a file of at most 64 kB that belongs to this user or root and that nobody else may read or change.
// Failures call the content `what`, such as "tokens", and never repeat it.
Expected<std::string> read_secret_file(const std::string& path, const std::string& what);

// The one line of such a file, 1 to 256 characters. Failures name the key that names the file.
Expected<std::string> read_password_file(const std::string& path, const std::string& key);

}  // namespace traygauge
