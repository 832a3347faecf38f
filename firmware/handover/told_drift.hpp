// What a hub tells of a station's drift to who asks over its socket, such as `traygauge check`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/handover/local_socket.hpp"

namespace traygauge {

// What the last scans of a station say of one value together.
struct ToldTrend {
  std::string check;  // "scale_percent": its unit ends the name
  double median = 0.0;
  double sigma = 0.0;       // the median's standard error
  std::uint64_t scans = 0;  // that the median is taken over
  std::string drift;        // a sentence for people; empty where it does not drift

  friend bool operator==(const ToldTrend&, const ToldTrend&) = default;
};

// {"trends":[{"check","median","sigma","scans","drift"}, …]}; reading fails with what was expected.
std::string told_drift_json(const std::vector<ToldTrend>& trends);
Expected<std::vector<ToldTrend>> read_told_drift(const std::string& text);

// Connects, asks and waits for the answer for at most `limit`. Who asks is no station for the hub, so that a
// running station keeps its connection. Fails where no hub answers there.
Expected<std::vector<ToldTrend>> ask_drift(const std::filesystem::path& socket, const std::string& station,
                                           Milliseconds limit);

}  // namespace traygauge
