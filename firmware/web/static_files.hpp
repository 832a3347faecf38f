// The files of the page, all in memory: after the start no request reaches the file system.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/web/http_message.hpp"

namespace traygauge {

class StaticFiles {
 public:
  // Together; a page is some 300 kB, the 3-D library 1.3 MB.
  static constexpr std::size_t kMaxBytes = 4UL * 1024 * 1024;

  // Whether a file of that name has one of the endings of which a page is made.
  static bool may_hold(std::string_view name);
  // A file at /`name`, such as "index.html" or "icons/cup.svg"; the ending tells its type.
  Expected<void> add(const std::string& name, std::string content);
  // Reads those files, and no others, from a folder.
  Expected<void> read(const std::filesystem::path& folder, const std::vector<std::string>& names);

  bool holds(const HttpRequest& request) const { return find(request) != nullptr; }
  // 304 where the client has it. The root and folders have index.html.
  HttpResponse answer(const HttpRequest& request) const;

 private:
  struct File {
    std::string content_type;
    std::string etag;
    std::shared_ptr<const std::string> content;
  };
  const File* find(const HttpRequest& request) const;

  std::map<std::string, File, std::less<>> files_;  // by path, "/index.html"
  std::size_t bytes_ = 0;
};

}  // namespace traygauge
