#include "simulator/scenes/mesh_reader.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "simulator/capture/input_bytes.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxMeshBytes = std::size_t{512} << 20U;
constexpr std::size_t kMaxElements = 4'000'000;
constexpr std::size_t kMaxCorners = 64;  // of a polygon
constexpr const char* kExpected = "a mesh as .obj or .ply";

class Lines {
 public:
  Lines(const InputFile& file, std::string_view text) : file_(file), text_(text) {}

  // The words of the next line; false at the end.
  bool next(std::vector<std::string_view>& words) {
    words.clear();
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view line = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++number_;
    while (!line.empty()) {
      const std::size_t begin = line.find_first_not_of(" \t\r");
      if (begin == std::string_view::npos) break;
      line.remove_prefix(begin);
      const std::size_t length = std::min(line.find_first_of(" \t\r"), line.size());
      words.push_back(line.substr(0, length));
      line.remove_prefix(length);
    }
    return true;
  }

  std::size_t offset() const { return std::min(at_, text_.size()); }

  [[noreturn]] void fail(const std::string& expected) const {
    throw InputError(file_, expected, "something else in line " + std::to_string(number_),
                     "export the mesh again");
  }

  template <class Number>
  Number number(std::string_view word, const char* expected) const {
    Number value{};
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (problem != std::errc() || end != word.data() + word.size()) fail(expected);
    return value;
  }

 private:
  const InputFile& file_;
  std::string_view text_;
  std::size_t at_ = 0;
  int number_ = 0;
};

[[noreturn]] void fail(const InputFile& file, const std::string& expected, const std::string& found) {
  throw InputError(file, expected, found, "export the mesh again");
}

void add_vertex(TriangleMesh& mesh, const InputFile& file, const std::array<double, 3>& place) {
  if (mesh.vertices.size() >= kMaxElements) fail(file, "at most 4 million vertices", "more");
  for (const double coordinate : place) {
    if (!std::isfinite(coordinate)) fail(file, "finite coordinates", "a vertex without");
  }
  mesh.vertices.emplace_back(Eigen::Vector3d(place[0], place[1], place[2]).cast<float>());
}

void add_polygon(TriangleMesh& mesh, const InputFile& file, const std::vector<std::uint32_t>& corners) {
  if (corners.size() < 3 || corners.size() > kMaxCorners) fail(file, "faces with 3 to 64 corners", "another");
  if (mesh.triangles.size() >= kMaxElements) fail(file, "at most 4 million faces", "more");
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

TriangleMesh read_obj(const InputFile& file, std::string_view text) {
  TriangleMesh mesh;
  Lines lines(file, text);
  std::vector<std::string_view> words;
  std::vector<std::uint32_t> corners;
  while (lines.next(words)) {
    if (words.empty()) continue;
    if (words[0] == "v") {
      if (words.size() < 4) lines.fail("a vertex with three coordinates");
      std::array<double, 3> place{};
      for (std::size_t i = 0; i < 3; ++i) place[i] = lines.number<double>(words[i + 1], "a coordinate");
      add_vertex(mesh, file, place);
    } else if (words[0] == "f") {
      corners.clear();
      for (std::size_t i = 1; i < words.size(); ++i) {
        const auto count = static_cast<std::int64_t>(mesh.vertices.size());
        const auto index =
            lines.number<std::int64_t>(words[i].substr(0, words[i].find('/')), "the number of a vertex");
        const std::int64_t from_zero = index > 0 ? index - 1 : count + index;  // negative: from the last
        if (index == 0 || from_zero < 0 || from_zero >= count) lines.fail("the number of an earlier vertex");
        corners.push_back(static_cast<std::uint32_t>(from_zero));
      }
      add_polygon(mesh, file, corners);
    }
  }
  return mesh;
}

struct PlyProperty {
  std::string name;
  std::string type;
  std::string count_type;  // of a list; else empty
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyFormat : std::uint8_t { ascii, binary_little_endian, binary_big_endian };
constexpr std::array<std::string_view, 3> kPlyFormats = {"ascii", "binary_little_endian",
                                                         "binary_big_endian"};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
};

PlyHeader read_ply_header(Lines& lines) {
  PlyHeader header;
  std::vector<std::string_view> words;
  if (!lines.next(words) || words.size() != 1 || words[0] != "ply") lines.fail("\"ply\"");
  while (true) {
    if (!lines.next(words)) lines.fail("\"end_header\"");
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") return header;
    if (words[0] == "format" && words.size() == 3) {
      const auto* const known = std::find(kPlyFormats.begin(), kPlyFormats.end(), words[1]);
      if (known == kPlyFormats.end()) lines.fail("format ascii, binary_little_endian or binary_big_endian");
      header.format = static_cast<PlyFormat>(known - kPlyFormats.begin());
    } else if (words[0] == "element" && words.size() == 3) {
      const auto count = lines.number<std::size_t>(words[2], "how many there are");
      if (count > kMaxElements) lines.fail("at most 4 million vertices and faces");
      header.elements.push_back({std::string(words[1]), count, {}});
    } else if (words[0] == "property" && !header.elements.empty() && words.size() == 3) {
      header.elements.back().properties.push_back({std::string(words[2]), std::string(words[1]), ""});
    } else if (words[0] == "property" && !header.elements.empty() && words.size() == 5 &&
               words[1] == "list") {
      header.elements.back().properties.push_back(
          {std::string(words[4]), std::string(words[3]), std::string(words[2])});
    } else {
      lines.fail("a line of a PLY header");
    }
  }
}

// The values of a PLY body one after the other, whatever their type and format.
class PlyValues {
 public:
  PlyValues(const InputFile& file, const PlyHeader& header, std::string_view body, Lines& lines)
      : file_(file), format_(header.format), body_(body), lines_(lines) {}

  double next(const std::string& type) {
    return format_ == PlyFormat::ascii ? next_word() : next_binary(type);
  }

 private:
  template <class Value>
  double take() {
    static_assert(std::endian::native == std::endian::little);
    if (body_.size() < sizeof(Value)) fail(file_, "a whole PLY file", "one that ends early");
    std::array<char, sizeof(Value)> bytes{};
    std::copy_n(body_.begin(), sizeof(Value), bytes.begin());
    if (format_ == PlyFormat::binary_big_endian) std::reverse(bytes.begin(), bytes.end());
    body_.remove_prefix(sizeof(Value));
    return static_cast<double>(std::bit_cast<Value>(bytes));
  }

  double next_binary(const std::string& type) {
    if (type == "char" || type == "int8") return take<std::int8_t>();
    if (type == "uchar" || type == "uint8") return take<std::uint8_t>();
    if (type == "short" || type == "int16") return take<std::int16_t>();
    if (type == "ushort" || type == "uint16") return take<std::uint16_t>();
    if (type == "int" || type == "int32") return take<std::int32_t>();
    if (type == "uint" || type == "uint32") return take<std::uint32_t>();
    if (type == "float" || type == "float32") return take<float>();
    if (type == "double" || type == "float64") return take<double>();
    fail(file_, "a number type of PLY", type);
  }

  double next_word() {
    while (at_ == words_.size()) {
      if (!lines_.next(words_)) fail(file_, "a whole PLY file", "one that ends early");
      at_ = 0;
    }
    return lines_.number<double>(words_[at_++], "a number");
  }

  const InputFile& file_;
  PlyFormat format_;
  std::string_view body_;
  Lines& lines_;
  std::vector<std::string_view> words_;
  std::size_t at_ = 0;
};

TriangleMesh read_ply(const InputFile& file, std::string_view text) {
  Lines lines(file, text);
  const PlyHeader header = read_ply_header(lines);
  PlyValues values(file, header, text.substr(lines.offset()), lines);
  TriangleMesh mesh;
  std::vector<std::uint32_t> corners;
  for (const PlyElement& element : header.elements) {
    for (std::size_t i = 0; i < element.count; ++i) {
      std::array<double, 3> place{NAN, NAN, NAN};
      for (const PlyProperty& property : element.properties) {
        if (property.count_type.empty()) {
          const double value = values.next(property.type);
          if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
            place[static_cast<std::size_t>(property.name[0] - 'x')] = value;
          continue;
        }
        const double count = values.next(property.count_type);
        if (!(count >= 0.0 && count <= static_cast<double>(kMaxCorners)))
          fail(file, "lists of up to 64 values", "a longer one");
        const bool is_face =
            element.name == "face" && (property.name == "vertex_indices" || property.name == "vertex_index");
        corners.clear();
        for (int k = 0; k < static_cast<int>(count); ++k) {
          const double index = values.next(property.type);
          if (!is_face) continue;
          if (!(index >= 0.0 && index < static_cast<double>(mesh.vertices.size())))
            fail(file, "faces of vertices that are there", "another");
          corners.push_back(static_cast<std::uint32_t>(index));
        }
        if (is_face) add_polygon(mesh, file, corners);
      }
      if (element.name == "vertex") add_vertex(mesh, file, place);
    }
  }
  return mesh;
}

}  // namespace

std::vector<std::uint8_t> read_mesh_bytes(const InputFile& file) {
  return read_bytes(file, kMaxMeshBytes, kExpected);
}

TriangleMesh read_mesh(const InputFile& file) {
  const std::vector<std::uint8_t> bytes = read_mesh_bytes(file);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::string extension = file.path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? char(letter - 'A' + 'a') : letter;
  });
  if (extension != ".obj" && extension != ".ply")
    throw InputError(file, kExpected, "\"" + extension + "\"", "export the mesh as one of these");
  TriangleMesh mesh = extension == ".obj" ? read_obj(file, text) : read_ply(file, text);
  if (mesh.triangles.empty()) fail(file, "a mesh with faces", "none");
  return mesh;
}

}  // namespace traygauge
