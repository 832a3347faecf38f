// What a program runs with when somebody has written a configuration that it cannot use: the last one that it
// could.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace traygauge {

// What a configuration says of its own end: `on_bad_config`.
enum class OnBadConfig : std::uint8_t {
  keep,  // go on with the last good one
  stop,
};

// Copies what could be used to `last_good`, durably, where that holds something else. Returns why not; empty:
// it did.
std::string keep_last_good(const std::filesystem::path& file, const std::filesystem::path& last_good);

template <class Config>
struct ChosenConfig {
  Config config;
  std::string problem;  // empty: the configuration is the one that somebody wrote, and is kept
};

// `read` takes the file whose content counts, checks it and returns the configuration, or throws InputError
// or UsageError; `on_bad_config` says what a configuration wants. Without a path for the last good one a bad
// file throws, and so does a bad last good one.
template <class Read, class OnBad>
auto read_or_last_good(const std::filesystem::path& file, const std::filesystem::path& last_good, Read read,
                       OnBad on_bad_config) -> ChosenConfig<decltype(read(file))> {
  std::string problem;
  try {
    ChosenConfig<decltype(read(file))> chosen{read(file), {}};
    if (!last_good.empty()) chosen.problem = keep_last_good(file, last_good);
    return chosen;
  } catch (const std::runtime_error& error) {
    std::error_code ignored;
    if (last_good.empty() || !std::filesystem::exists(last_good, ignored)) throw;
    problem = error.what();
  }
  ChosenConfig<decltype(read(file))> chosen{read(last_good), {}};
  if (on_bad_config(chosen.config) == OnBadConfig::stop) read(file);  // throws what it threw before
  chosen.problem = "The configuration is not the one that was written, but the last good one: " + problem;
  return chosen;
}

}  // namespace traygauge
