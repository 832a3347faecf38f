#include "tests/firmware/api/yaml_document.hpp"

#include <yaml-cpp/yaml.h>

#include <stdexcept>

namespace traygauge::test {
namespace {

using Json = nlohmann::json;

// By YAML's core schema: what is quoted is text, what is plain may be something else.
Json read_scalar(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") return text;
  if (text == "true" || text == "false") return text == "true";
  const Json number = Json::parse(text, nullptr, false);
  return number.is_number() ? number : Json(text);
}

Json read_node(const YAML::Node& node) {
  if (node.IsNull()) return nullptr;
  if (node.IsScalar()) return read_scalar(node);
  if (node.IsSequence()) {
    Json list = Json::array();
    for (const YAML::Node& entry : node) list.push_back(read_node(entry));
    return list;
  }
  Json object = Json::object();
  for (const auto& entry : node) {
    const std::string& key = entry.first.Scalar();
    const bool is_new = object.emplace(key, read_node(entry.second)).second;
    if (!is_new) throw std::runtime_error("the key " + key + " stands there twice");
  }
  return object;
}

}  // namespace

nlohmann::json read_yaml(const std::filesystem::path& file) {
  return read_node(YAML::LoadFile(file.string()));
}

}  // namespace traygauge::test
