// firmware/api/openapi.yaml, and what was said over HTTP held against it.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/firmware/api/json_schema.hpp"

namespace traygauge::test {

struct Answer {
  int status = 0;
  std::string head;
  std::string body;

  nlohmann::json json() const { return nlohmann::json::parse(body); }
  // The value of that header, whatever its case; none where it is absent.
  std::optional<std::string> header(std::string_view name) const;
};

struct Exchange {
  std::string method;
  std::string target;  // with the query
  std::string request_body;
  Answer answer;
};

class ApiDescription {
 public:
  explicit ApiDescription(const std::filesystem::path& file);
  // That of this checkout, read once.
  static const ApiDescription& own();
  static const std::filesystem::path& own_file();

  const nlohmann::json& document() const { return document_; }
  // Follows a reference, where the value is one.
  const nlohmann::json& resolved(const nlohmann::json& value) const;

  // "GET /api/v1/scans/{id}", and which role it asks for.
  std::map<std::string, std::string> operations() const;
  // "GET /api/v1/scans/{id} 404": all that are described.
  std::set<std::string> answers() const;
  // Which of these an exchange is; empty where its address is not described.
  std::string answer_name(const Exchange& exchange) const;

  // A sentence for each thing that is not as described; each names the request.
  std::vector<std::string> objections(const Exchange& exchange) const;
  std::vector<std::string> misfits(const nlohmann::json& schema, const nlohmann::json& value) const;

  // Of an operation, those of its path included.
  std::vector<nlohmann::json> parameters(const std::string& path, const std::string& method) const;

 private:
  // The described path that a target fits, a literal one first; empty where there is none.
  std::string path_of(std::string_view target) const;
  std::vector<std::string> object_to(const Exchange& exchange) const;
  void check_query(const Exchange& exchange, const std::string& path, std::vector<std::string>& found) const;
  void check_head(const nlohmann::json& response, const Answer& answer,
                  std::vector<std::string>& found) const;
  void check_body(const nlohmann::json& content, const std::string& text, const std::string& type,
                  std::vector<std::string>& found) const;

  nlohmann::json document_;
  mutable std::map<std::string, JsonSchema> schemas_;  // by their text
};

}  // namespace traygauge::test
