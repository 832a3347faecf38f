// Files into memory, with a limit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "simulator/capture/input_error.hpp"

namespace traygauge {

// The bytes of a regular file of at most `max_bytes`; `expected` completes the sentence of the InputError.
std::vector<std::uint8_t> read_bytes(const InputFile& file, std::size_t max_bytes, const char* expected);

// The first bytes of a regular file, `max_bytes` at most; none where it cannot be read.
std::vector<std::uint8_t> read_first_bytes(const std::filesystem::path& file, std::size_t max_bytes);

}  // namespace traygauge
