#include "simulator/capture/calibration_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "simulator/capture/input_bytes.hpp"
#include "simulator/capture/json_file.hpp"
#include "simulator/capture/json_node.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxCalibrationBytes = std::size_t{1} << 20U;
constexpr const char* kCalibration = "a calibration file of OpenCV (YAML, XML or JSON)";
constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::size_t kMaxNumbers = 64;  // of one entry
constexpr NumberRange kAnyNumber{-1e9, 1e9};

// Names that programs give to the same, in lower case and without underscores.
constexpr std::array<std::string_view, 2> kWidthNames = {"imagewidth", "width"};
constexpr std::array<std::string_view, 2> kHeightNames = {"imageheight", "height"};
constexpr std::array<std::string_view, 2> kSizeNames = {"imagesize", "size"};
constexpr std::array<std::string_view, 6> kMatrixNames = {"cameramatrix",    "k",          "mtx",
                                                          "intrinsicmatrix", "intrinsics", "m1"};
constexpr std::array<std::string_view, 7> kDistortionNames = {
    "distortioncoefficients", "distcoeffs", "distcoeff", "distortion", "dist", "d", "d1"};
constexpr std::array<std::string_view, 2> kModelNames = {"distortionmodel", "cameramodel"};

// What stands under a name at the top of the file.
struct CalibrationEntry {
  std::string name;  // as written
  std::string text;
  std::optional<std::vector<double>> numbers;  // where the file's kind has them apart
  int line = 0;
};

using CalibrationEntries = std::map<std::string, CalibrationEntry>;

std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    if (c != '_' && c != '-') plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return plain;
}

bool is_blank(char c) {
  return kBlanks.find(c) != std::string_view::npos;
}

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// Top-level keys begin at the line's begin; what belongs to them is indented, or a list.
CalibrationEntries split_yaml(std::string_view text) {
  CalibrationEntries entries;
  CalibrationEntry* entry = nullptr;
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view row = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t comment = row.find(" #");
    if (comment != std::string_view::npos) row = row.substr(0, comment);
    if (row.empty() || row.front() == '%' || row.front() == '#' || row.starts_with("---")) continue;
    const std::size_t colon = row.find(':');
    if (!is_blank(row.front()) && row.front() != '-' && colon != std::string_view::npos) {
      const std::string name(without_blanks(row.substr(0, colon)));
      entry = &entries[plain_name(name)];
      *entry = {name, "", {}, line};
      row.remove_prefix(colon + 1);
    }
    if (entry != nullptr) entry->text += std::string(row) + "\n";
  }
  return entries;
}

// Elements within the outermost one.
CalibrationEntries split_xml(std::string_view text) {
  CalibrationEntries entries;
  int depth = 0;
  std::size_t content = 0;
  std::string name;
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at + 1)) {
    const std::size_t end = text.find('>', at);
    if (end == std::string_view::npos) break;
    const std::string_view tag = text.substr(at + 1, end - at - 1);
    if (tag.empty() || tag.front() == '?' || tag.front() == '!' || tag.back() == '/') continue;
    if (tag.front() != '/') {
      if (++depth == 2) {
        name = tag.substr(0, tag.find_first_of(kBlanks));
        content = end + 1;
      }
      continue;
    }
    if (depth-- != 2) continue;
    const auto line =
        static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(content), '\n'));
    entries[plain_name(name)] = {name, std::string(text.substr(content, at - content)), {}, line + 1};
  }
  return entries;
}

CalibrationEntries split_json(const std::filesystem::path& file) {
  CalibrationEntries entries;
  const JsonDocument document = read_json(file);
  const JsonNode root = document.root();
  for (const std::string& name : root.names()) {
    const JsonNode node = root.member(name.c_str());
    const auto data = node.is_object() ? node.find("data") : std::nullopt;
    CalibrationEntry entry{name, node.is_text() ? node.text() : "", {}, 0};
    const JsonNode list = data ? *data : node;
    const std::string plain = plain_name(name);
    const auto is_one_of = [&](const auto& names) {
      return std::find(names.begin(), names.end(), plain) != names.end();
    };
    if (list.is_list() && (is_one_of(kMatrixNames) || is_one_of(kDistortionNames) || is_one_of(kSizeNames))) {
      entry.numbers = list.nested_numbers(0, kMaxNumbers, kAnyNumber);
    } else if (is_one_of(kWidthNames) || is_one_of(kHeightNames)) {
      entry.numbers = {node.number(kAnyNumber)};
    }
    entries[plain] = entry;
  }
  return entries;
}

class Calibration {
 public:
  explicit Calibration(const InputFile& file) : file_(file.path) {
    const std::vector<std::uint8_t> bytes = read_bytes(file, kMaxCalibrationBytes, kCalibration);
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string_view text = without_blanks(all);
    if (text.starts_with("{")) {
      entries_ = split_json(file.path);
    } else if (text.starts_with("<")) {
      entries_ = split_xml(all);
    } else {
      entries_ = split_yaml(all);
    }
  }

  template <std::size_t N>
  const CalibrationEntry* find(const std::array<std::string_view, N>& names) const {
    for (const std::string_view name : names) {
      const auto found = entries_.find(std::string(name));
      if (found != entries_.end()) return &found->second;
    }
    return nullptr;
  }

  template <std::size_t N>
  const CalibrationEntry& require(const std::array<std::string_view, N>& names, const char* usual_name,
                                  const char* hint) const {
    if (const CalibrationEntry* entry = find(names)) return *entry;
    throw InputError({file_, usual_name}, "this key in " + std::string(kCalibration), "nothing", hint);
  }

  // Between brackets, commas and blanks; of a matrix those under "data".
  std::vector<double> numbers(const CalibrationEntry& entry) const {
    if (entry.numbers) return *entry.numbers;
    std::string_view text = entry.text;
    for (const std::string_view begin : {"data:", "<data>"}) {
      const std::size_t data = text.find(begin);
      if (data != std::string_view::npos) text.remove_prefix(data + begin.size());
    }
    text = text.substr(0, text.find('<'));
    std::vector<double> numbers;
    constexpr std::string_view between = " \t\r\n,[]";
    while (true) {
      text.remove_prefix(std::min(text.find_first_not_of(between), text.size()));
      const std::string_view word = text.substr(0, text.find_first_of(between));
      if (word.empty() || word.ends_with(':')) return numbers;
      text.remove_prefix(word.size());
      if (word != "-") numbers.push_back(number(entry, word));  // a dash begins an element of a list
      if (numbers.size() > kMaxNumbers) fail(entry, "fewer numbers", "more than 64");
    }
  }

  [[noreturn]] void fail(const CalibrationEntry& entry, const std::string& expected,
                         const std::string& found) const {
    throw InputError(InputProblem{file_, entry.name, expected, found,
                                  "calibrate the camera again, or correct it", entry.line});
  }

 private:
  double number(const CalibrationEntry& entry, std::string_view word) const {
    double value = 0.0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (problem != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      fail(entry, "finite numbers", std::string(word.substr(0, 24)));
    }
    return value;
  }

  std::filesystem::path file_;
  CalibrationEntries entries_;
};

int whole_number(const Calibration& calibration, const CalibrationEntry& entry,
                 const std::vector<double>& numbers, std::size_t index) {
  const double value = index < numbers.size() ? numbers[index] : 0.0;
  if (value >= kMinPictureSide && value <= kMaxPictureSide && value == std::floor(value)) {
    return static_cast<int>(value);
  }
  calibration.fail(entry, "a whole number from 16 to 8192",
                   numbers.empty() ? "nothing" : std::to_string(value));
}

PictureSize read_size(const Calibration& calibration, std::optional<PictureSize> size) {
  if (size) return *size;
  if (const CalibrationEntry* both = calibration.find(kSizeNames)) {
    const std::vector<double> numbers = calibration.numbers(*both);
    return {whole_number(calibration, *both, numbers, 0), whole_number(calibration, *both, numbers, 1)};
  }
  constexpr const char* hint = R"(add it, or name the file as {"file", "width", "height"})";
  const CalibrationEntry& width = calibration.require(kWidthNames, "image_width", hint);
  const CalibrationEntry& height = calibration.require(kHeightNames, "image_height", hint);
  return {whole_number(calibration, width, calibration.numbers(width), 0),
          whole_number(calibration, height, calibration.numbers(height), 0)};
}

void refuse_fisheye(const Calibration& calibration) {
  const CalibrationEntry* model = calibration.find(kModelNames);
  if (model == nullptr) return;
  const std::string name = plain_name(without_blanks(model->text));
  if (name.find("fisheye") == std::string::npos && name.find("equidistant") == std::string::npos) return;
  calibration.fail(*model, "OpenCV's pinhole model (plumb_bob, rational_polynomial)",
                   printable(std::string(without_blanks(model->text))));
}

}  // namespace

CameraDescription read_calibration_file(const InputFile& file, std::optional<PictureSize> size) {
  const Calibration calibration(file);
  refuse_fisheye(calibration);
  constexpr const char* hint =
      "calibrate the camera with OpenCV, or write fx, fy, cx, cy and distortion yourself";
  CameraDescription camera;
  const CalibrationEntry& matrix = calibration.require(kMatrixNames, "camera_matrix", hint);
  const CalibrationEntry& distortion = calibration.require(kDistortionNames, "distortion_coefficients", hint);
  camera.size = read_size(calibration, size);
  const std::vector<double> k = calibration.numbers(matrix);
  const bool is_pinhole =
      k.size() == 9 && k[1] == 0.0 && k[3] == 0.0 && k[6] == 0.0 && k[7] == 0.0 && k[8] == 1.0;
  if (!is_pinhole) {
    calibration.fail(matrix, "the 9 numbers fx 0 cx, 0 fy cy, 0 0 1",
                     k.size() == 9 ? "another matrix" : std::to_string(k.size()) + " numbers");
  }
  camera.fx_px = k[0];
  camera.cx_px = k[2];
  camera.fy_px = k[4];
  camera.cy_px = k[5];
  const std::vector<double> coefficients = calibration.numbers(distortion);
  if (!set_distortion(coefficients, camera)) {
    calibration.fail(distortion, kDistortionCounts, std::to_string(coefficients.size()) + " numbers");
  }
  return camera;
}

}  // namespace traygauge
