#include "firmware/web/static_files.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <utility>

namespace traygauge {
namespace {

struct FileType {
  std::string_view ending;
  std::string_view content_type;
};

constexpr auto kFileTypes = std::to_array<FileType>({
    {".html", "text/html; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".json", "application/json"},
    {".yaml", "application/yaml"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".ico", "image/x-icon"},
    {".woff2", "font/woff2"},
    {".webmanifest", "application/manifest+json"},
    {".txt", "text/plain; charset=utf-8"},
});

const FileType* type_of(std::string_view name) {
  const auto* const type = std::find_if(kFileTypes.begin(), kFileTypes.end(),
                                        [name](const FileType& t) { return name.ends_with(t.ending); });
  return type == kFileTypes.end() ? nullptr : type;
}

// FNV-1a, 64 bits: a changed file gets another tag. Nobody gains by making two alike.
std::string entity_tag(const std::string& content) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : content) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  std::string tag = "\"";
  for (unsigned shift = 0; shift < 64; shift += 4) tag += "0123456789abcdef"[(hash >> shift) & 0xFU];
  return tag + "\"";
}

// If-None-Match holds a list, or "*".
bool names_tag(std::string_view list, std::string_view tag) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(','), list.size());
    std::string_view entry = list.substr(0, end);
    list.remove_prefix(std::min(end + 1, list.size()));
    entry.remove_prefix(std::min(entry.find_first_not_of(" \t"), entry.size()));
    if (entry.starts_with("W/")) entry.remove_prefix(2);
    const std::size_t last = entry.find_last_not_of(" \t");
    entry = entry.substr(0, last == std::string_view::npos ? 0 : last + 1);
    if (entry == tag || entry == "*") return true;
  }
  return false;
}

}  // namespace

bool StaticFiles::may_hold(std::string_view name) {
  return type_of(name) != nullptr;
}

Expected<void> StaticFiles::add(const std::string& name, std::string content) {
  const FileType* const type = type_of(name);
  if (type == nullptr) return Failure{name + ": a file of the page has an ending such as .html or .js"};
  if (bytes_ + content.size() > kMaxBytes)
    return Failure{name + ": the page's files have more than " + std::to_string(kMaxBytes) +
                   " bytes together"};
  bytes_ += content.size();
  File file{std::string(type->content_type), entity_tag(content),
            std::make_shared<const std::string>(std::move(content))};
  const bool is_new = files_.emplace("/" + name, std::move(file)).second;
  if (!is_new) return Failure{name + ": the page has this file already"};
  return {};
}

Expected<void> StaticFiles::read(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    std::ifstream file(folder / name, std::ios::binary);
    std::string content{std::istreambuf_iterator<char>(file), {}};
    if (!file || content.empty())
      return Failure{(folder / name).string() + ": a file of the page is missing or empty; install it again"};
    Expected<void> added = add(name, std::move(content));
    if (!added.ok()) return added;
  }
  return {};
}

const StaticFiles::File* StaticFiles::find(const HttpRequest& request) const {
  std::string path = request.path();
  if (request.segments.empty()) {
    path = "/index.html";
  } else if (request.is_folder) {
    path += "/index.html";
  }
  const auto found = files_.find(path);
  return found == files_.end() ? nullptr : &found->second;
}

HttpResponse StaticFiles::answer(const HttpRequest& request) const {
  const File* const file = find(request);
  if (file == nullptr) return error_response(404, "not_found", "There is nothing at this address.");
  HttpResponse response;
  // Asked for again each time, which costs a line while the tag is the same: a new program shows its own
  // page.
  response.headers = {{"ETag", file->etag}, {"Cache-Control", "no-cache"}};
  const std::string* const known = request.header("if-none-match");
  if (known != nullptr && names_tag(*known, file->etag)) {
    response.status = 304;
    response.content_type.clear();
    return response;
  }
  response.content_type = file->content_type;
  response.body = file->content;
  return response;
}

}  // namespace traygauge
