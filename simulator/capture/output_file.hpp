// Files out, whole or not at all.
#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

namespace traygauge {

// A result that could not be stored; what() names the file and why.
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::filesystem::path& file, const std::string& reason);
};

// `encode` writes to the stream and says whether it could; errno has the reason. Throws OutputError, and
// leaves no half-written file behind.
void write_stream(const std::filesystem::path& file, const std::function<bool(std::FILE*)>& encode);

}  // namespace traygauge
