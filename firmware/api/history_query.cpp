#include "firmware/api/history_query.hpp"

#include <algorithm>
#include <string>

#include "firmware/base/wall_clock.hpp"
#include "firmware/store/scan_document.hpp"

namespace traygauge {
namespace {

Failure expected(const NamedText& parameter, const std::string& what) {
  return {parameter.first + ": expected " + what + ", found " +
          (is_plain_text(parameter.second, 100) ? parameter.second : "something else")};
}

Expected<std::optional<std::int64_t>> read_time(const NamedText& parameter) {
  const auto time = parse_utc(parameter.second);
  if (!time) return expected(parameter, "a time such as 2026-11-27T07:40:12Z");
  return time;
}

Expected<std::optional<bool>> read_truth(const NamedText& parameter) {
  if (parameter.second == "true") return std::optional(true);
  if (parameter.second == "false") return std::optional(false);
  return expected(parameter, "true or false");
}

Expected<std::string> read_text(const NamedText& parameter) {
  constexpr std::size_t kMaxBytes = 200;
  if (!is_plain_text(parameter.second, kMaxBytes)) return expected(parameter, "text of at most 200 bytes");
  return parameter.second;
}

template <class Value>
Expected<void> take(Expected<Value> read, Value& value) {
  if (!read.ok()) return Failure{read.failure()};
  value = std::move(*read);
  return {};
}

Expected<void> read_parameter(const NamedText& parameter, HistoryFilter& filter,
                              const std::vector<std::string_view>& others) {
  const std::string& name = parameter.first;
  if (name == "from") return take(read_time(parameter), filter.from_ms);
  if (name == "to") return take(read_time(parameter), filter.to_ms);
  if (name == "station") return take(read_text(parameter), filter.station);
  if (name == "status") return take(read_text(parameter), filter.status);
  if (name == "food") return take(read_text(parameter), filter.food);
  if (name == "text") return take(read_text(parameter), filter.text);
  if (name == "corrected") return take(read_truth(parameter), filter.is_corrected);
  if (name == "wrong") return take(read_truth(parameter), filter.is_wrong);
  if (name == "superseded") {
    std::optional<bool> with = true;
    if (Expected<void> taken = take(read_truth(parameter), with); !taken.ok()) return taken;
    filter.with_superseded = *with;
    return {};
  }
  if (std::find(others.begin(), others.end(), name) != others.end()) return {};
  return Failure{"no parameter is called " + (is_plain_text(name, 50) ? name : "so") +
                 "; firmware/README.md lists those that are"};
}

}  // namespace

Expected<HistoryFilter> parse_history_filter(const HttpRequest& request,
                                             const std::vector<std::string_view>& others) {
  HistoryFilter filter;
  for (const NamedText& parameter : request.query) {
    if (const Expected<void> read = read_parameter(parameter, filter, others); !read.ok())
      return Failure{read.failure()};
  }
  return filter;
}

}  // namespace traygauge
