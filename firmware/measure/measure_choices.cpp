#include "firmware/measure/measure_choices.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>

#include "core/pipeline/measurement.hpp"
#include "firmware/base/exit_status.hpp"
#include "firmware/command/program.hpp"
#include "simulator/capture/input_error.hpp"
#include "simulator/capture/output_file.hpp"

namespace traygauge {
namespace {

constexpr std::uint64_t kDefaultSeed = 0;

// The whole of `text` as a number.
template <class Number>
bool parse_whole(const std::string& text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, number);
  return problem == std::errc() && stop == end;
}

}  // namespace

void add_items_option(Command& command, int& items) {
  command
      .add_option("--items", items,
                  "How many food items there are, where they are found and not given; default: as found")
      .range(1, static_cast<int>(kMaxItems));
}

void check_hint(int items, LabelSource labels) {
  if (items == 0 || labels == LabelSource::automatic) return;
  throw UsageError("--items: the outlines that are given say how many there are; add --labels auto");
}

void check_label_source(const std::string& typed) {
  if (typed.empty() || typed == "given" || typed == "auto") return;
  throw UsageError("--labels: expected given or auto, found " + printable(typed));
}

LabelSource choose_labels(const std::string& typed, const Capture& capture, const std::array<int, 2>& pair) {
  check_label_source(typed);
  const bool has_labels = std::any_of(pair.begin(), pair.end(), [&](int i) {
    return capture.views[static_cast<std::size_t>(i)].labels.has_value();
  });
  if (typed == "auto" || (typed.empty() && !has_labels)) return LabelSource::automatic;
  require_labels(capture, pair);
  return LabelSource::given;
}

void require_labels(const Capture& capture, const std::array<int, 2>& pair) {
  for (const int i : pair) {
    if (capture.views[static_cast<std::size_t>(i)].labels) continue;
    throw InputError({capture.file, "views[" + std::to_string(i) + "].labels"}, "a label picture", "nothing",
                     "outline dish and food, or measure with --labels auto");
  }
}

std::array<int, 2> choose_pair(const std::string& typed, const Capture& capture) {
  std::array<int, 2> pair{0, 1};
  const int count = static_cast<int>(capture.views.size());
  if (typed.empty()) {
    if (!capture.pairs.empty()) return capture.pairs.front();
    if (count >= 2) return pair;
    throw InputError({capture.file, "views"}, "at least two views", "one", "take a second picture");
  }
  const std::size_t comma = typed.find(',');
  const bool parsed = comma != std::string::npos && parse_whole(typed.substr(0, comma), pair[0]) &&
                      parse_whole(typed.substr(comma + 1), pair[1]);
  const auto exists = [&](int view) { return view >= 0 && view < count; };
  if (parsed && exists(pair[0]) && exists(pair[1])) return pair;
  throw UsageError("--pair: expected two views A,B from 0 to " + std::to_string(count - 1) + ", found " +
                   printable(typed));
}

void check_output(const std::string& file) {
  if (file.empty()) return;
  const std::filesystem::path path(file);
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw OutputError(path, "it is a folder");
  if (!std::filesystem::is_directory(folder, ignored)) throw OutputError(path, "its folder does not exist");
}

std::uint64_t parse_seed(const std::string& typed) {
  std::uint64_t seed = kDefaultSeed;
  if (typed.empty() || parse_whole(typed, seed)) return seed;
  throw UsageError("--seed: expected a whole number from 0 to 18446744073709551615, found " +
                   printable(typed));
}

}  // namespace traygauge
