// The filters that a request for scans carries.
#pragma once

#include "firmware/base/expected.hpp"
#include "firmware/store/history.hpp"
#include "firmware/web/http_message.hpp"

namespace traygauge {

// from, to (UTC), station, status, food, text, corrected, wrong, superseded. An unknown parameter is a
// failure, because a misspelt filter would admit everything; `others` are known beside these.
Expected<HistoryFilter> parse_history_filter(const HttpRequest& request,
                                             const std::vector<std::string_view>& others);

}  // namespace traygauge
