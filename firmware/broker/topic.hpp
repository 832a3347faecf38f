// The topics by which hubs and collectors talk: PREFIX/v1/NAME/WHAT. firmware/fleet/README.md lists them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace traygauge {

// Levels of letters, digits, '-' and '_', with '/' between them, 64 characters at most.
bool is_topic_prefix(std::string_view text);

// A text as one level of a topic. What is neither a letter, a digit, '-' nor '_' becomes %XX, so that no text
// leaves its level, is a wildcard or ends the topic; some brokers take no '.' and no space.
std::string topic_level(std::string_view text);

// "traygauge/v1/kitchen/scan"
std::string topic_of(std::string_view prefix, std::string_view name, std::string_view what);

struct TopicParts {
  std::string_view level;  // the name's, as it stands there
  std::string_view what;
};
// None where the topic is none of this prefix.
std::optional<TopicParts> split_topic(std::string_view prefix, std::string_view topic);

}  // namespace traygauge
