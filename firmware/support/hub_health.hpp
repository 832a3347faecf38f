// What the hub says of itself.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace traygauge {

// Asks `GET /health` at the first address of `listen` that this machine reaches, without a token. The answer
// as it came, or a sentence why there is none.
std::string ask_hub_health(const std::vector<std::string>& listen,
                           std::chrono::milliseconds limit = std::chrono::seconds(3));

}  // namespace traygauge
