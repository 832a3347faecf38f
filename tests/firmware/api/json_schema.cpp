#include "tests/firmware/api/json_schema.hpp"

#include <stdexcept>

// Without it the library ends the program where a schema is wrong.
#define VALIJSON_USE_EXCEPTIONS 1
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace traygauge::test {

using valijson::adapters::NlohmannJsonAdapter;

struct JsonSchema::Compiled {
  valijson::Schema schema;
};

// The library knows draft 7, of which OpenAPI 3.1 has all that is used here.
JsonSchema::JsonSchema(const nlohmann::json& schema, const nlohmann::json& root)
    : compiled_(std::make_unique<Compiled>()) {
  const nlohmann::json whole = {{"allOf", nlohmann::json::array({schema})},
                                {"components", root.at("components")}};
  valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
  parser.populateSchema(NlohmannJsonAdapter(whole), compiled_->schema);
}

JsonSchema::JsonSchema(JsonSchema&&) noexcept = default;
JsonSchema& JsonSchema::operator=(JsonSchema&&) noexcept = default;
JsonSchema::~JsonSchema() = default;

std::vector<std::string> JsonSchema::misfits(const nlohmann::json& value) const {
  valijson::Validator validator;
  valijson::ValidationResults results;
  std::vector<std::string> sentences;
  if (validator.validate(compiled_->schema, NlohmannJsonAdapter(value), &results)) return sentences;
  for (const auto& error : results) {
    std::string sentence;
    for (const std::string& part : error.context) sentence += part;
    sentence += ": ";
    sentence += error.description;
    sentences.push_back(sentence);
  }
  return sentences;
}

}  // namespace traygauge::test
