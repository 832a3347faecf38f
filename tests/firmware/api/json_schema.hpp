// JSON that is held against JSON Schema.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace traygauge::test {

class JsonSchema {
 public:
  // References in `schema` point into `root`, "#/components/schemas/Scan". Throws where one leads nowhere.
  JsonSchema(const nlohmann::json& schema, const nlohmann::json& root);
  JsonSchema(JsonSchema&&) noexcept;
  JsonSchema& operator=(JsonSchema&&) noexcept;
  ~JsonSchema();

  // A sentence for each thing that does not fit.
  std::vector<std::string> misfits(const nlohmann::json& value) const;

 private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

}  // namespace traygauge::test
