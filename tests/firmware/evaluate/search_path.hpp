// Which programs are installed, as far as a test says so.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace traygauge {

// Programs are searched for in `folder` alone while the object exists.
class SearchPath {
 public:
  explicit SearchPath(const std::filesystem::path& folder) : before_(std::getenv("PATH")) {
    setenv("PATH", folder.c_str(), 1);
  }
  SearchPath(const SearchPath&) = delete;
  SearchPath& operator=(const SearchPath&) = delete;
  ~SearchPath() { setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_;
};

}  // namespace traygauge
