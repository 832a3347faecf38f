// By a receipt a collector says which events it has stored.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace traygauge {

// {"ids": […]}, of as many as fit into kMaxReceiptBytes; `ids` becomes what is left.
std::string make_receipt(std::span<const std::string>& ids);

// None where it is no receipt.
std::optional<std::vector<std::string>> parse_receipt(const std::string& payload);

inline constexpr std::size_t kMaxReceiptBytes = 64UL * 1024;

}  // namespace traygauge
