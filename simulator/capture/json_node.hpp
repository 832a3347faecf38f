// A JSON document, and values in it that know where they stand, so that every error names file and key.
//
// nlohmann/json, which is behind them, takes two seconds to compile wherever it is included: those who read
// documents through these need not.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace traygauge {

// Inclusive limits of a number.
struct NumberRange {
  double min = 0.0;
  double max = 0.0;
};

// Where a document came from, for who has to correct it.
struct JsonOrigin {
  std::filesystem::path file;
  std::map<std::string, int> lines;  // of the values by their keys, from 1; empty where they are not known
};

// Refers to the document, which must outlive it. Every reader throws InputError.
class JsonNode {
 public:
  JsonNode(const nlohmann::json& value, const JsonOrigin& origin, std::string key = {});

  JsonNode member(const char* name) const;  // of an object; must be there
  std::optional<JsonNode> find(const char* name) const;
  std::vector<JsonNode> elements(std::size_t min_count, std::size_t max_count) const;
  std::vector<std::string> names() const;  // of an object's members

  double number(NumberRange range) const;  // finite
  double positive_number(double max) const;
  int integer(int min, int max) const;
  std::string text() const;  // not empty
  bool is_text() const;
  bool is_object() const;
  bool is_list() const;
  bool is_empty() const;  // of a list
  bool truth() const;     // true or false
  std::vector<double> numbers(std::size_t count, NumberRange range) const;
  // Of a list, and of lists in it; each holds so many elements.
  std::vector<double> nested_numbers(std::size_t min_count, std::size_t max_count, NumberRange range) const;

  const std::filesystem::path& file() const { return origin_->file; }
  const std::string& key() const { return key_; }
  [[noreturn]] void fail(const std::string& expected, const std::string& hint) const;

 private:
  void require_object() const;
  int line() const;

  const nlohmann::json* value_;
  const JsonOrigin* origin_;
  std::string key_;
};

// What a file held. Its nodes refer to it.
class JsonDocument {
 public:
  JsonDocument(JsonOrigin origin, nlohmann::json value);

  JsonNode root() const { return {*value_, origin_}; }
  const nlohmann::json& value() const { return *value_; }
  std::string dump() const;  // in one line of ASCII

 private:
  JsonOrigin origin_;
  std::shared_ptr<const nlohmann::json> value_;  // shared: knows how to delete what is not defined here
};

}  // namespace traygauge
