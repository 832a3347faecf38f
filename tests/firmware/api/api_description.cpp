#include "tests/firmware/api/api_description.hpp"

#include <algorithm>
#include <cctype>

#include "tests/firmware/api/yaml_document.hpp"

namespace traygauge::test {
namespace {

using Json = nlohmann::json;
using Sentences = std::vector<std::string>;

std::string in_case(std::string text, int (*change)(int)) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [change](unsigned char c) { return static_cast<char>(change(c)); });
  return text;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

bool fits(const std::vector<std::string>& pattern, const std::vector<std::string>& path) {
  return std::equal(
      pattern.begin(), pattern.end(), path.begin(), path.end(),
      [](const std::string& wanted, const std::string& part) { return wanted == part || wanted[0] == '{'; });
}

bool is_method(const std::string& key) {
  static const std::set<std::string> methods = {"get", "put", "post", "delete", "patch"};
  return methods.contains(key);
}

}  // namespace

std::optional<std::string> Answer::header(std::string_view name) const {
  const std::string wanted = in_case("\r\n" + std::string(name) + ": ", std::tolower);
  const std::size_t at = in_case(head, std::tolower).find(wanted);
  if (at == std::string::npos) return std::nullopt;
  const std::size_t begin = at + wanted.size();
  return head.substr(begin, head.find("\r\n", begin) - begin);
}

ApiDescription::ApiDescription(const std::filesystem::path& file) : document_(read_yaml(file)) {}

const std::filesystem::path& ApiDescription::own_file() {
  static const std::filesystem::path file = TRAYGAUGE_SOURCE_DIR "/firmware/api/openapi.yaml";
  return file;
}

const ApiDescription& ApiDescription::own() {
  static const ApiDescription description(own_file());
  return description;
}

const Json& ApiDescription::resolved(const Json& value) const {
  if (!value.is_object() || !value.contains("$ref")) return value;
  return resolved(document_.at(Json::json_pointer(value["$ref"].get<std::string>().substr(1))));
}

std::map<std::string, std::string> ApiDescription::operations() const {
  std::map<std::string, std::string> all;
  for (const auto& [path, item] : document_["paths"].items()) {
    for (const auto& [method, operation] : item.items()) {
      if (!is_method(method)) continue;
      std::string name = in_case(method, std::toupper);
      name += " " + path;
      all[name] = operation.at("x-role");
    }
  }
  return all;
}

std::set<std::string> ApiDescription::answers() const {
  std::set<std::string> all;
  for (const auto& [name, role] : operations()) {
    const std::size_t space = name.find(' ');
    const std::string method = in_case(name.substr(0, space), std::tolower);
    for (const auto& entry : document_["paths"][name.substr(space + 1)][method]["responses"].items())
      all.insert(name + " " + entry.key());
  }
  return all;
}

std::string ApiDescription::path_of(std::string_view target) const {
  std::vector<std::string> wanted = split(target.substr(0, target.find('?')), '/');
  if (wanted.size() > 2 && wanted.back().empty()) wanted.pop_back();  // a slash at the end does not matter
  std::string found;
  for (const auto& [path, item] : document_["paths"].items()) {
    const bool is_better = found.empty() || found.find('{') != std::string::npos;
    if (is_better && fits(split(path, '/'), wanted)) found = path;
  }
  return found;
}

std::string ApiDescription::answer_name(const Exchange& exchange) const {
  const std::string path = path_of(exchange.target);
  if (path.empty()) return {};
  std::string name = exchange.method;
  name += " " + path + " " + std::to_string(exchange.answer.status);
  return name;
}

std::vector<Json> ApiDescription::parameters(const std::string& path, const std::string& method) const {
  const Json& item = document_["paths"][path];
  std::vector<Json> all;
  for (const Json& parameter : item.value("parameters", Json::array())) all.push_back(resolved(parameter));
  for (const Json& parameter : item[method].value("parameters", Json::array()))
    all.push_back(resolved(parameter));
  return all;
}

Sentences ApiDescription::misfits(const Json& schema, const Json& value) const {
  const std::string text = schema.dump();
  auto known = schemas_.find(text);
  if (known == schemas_.end()) known = schemas_.emplace(text, JsonSchema(schema, document_)).first;
  return known->second.misfits(value);
}

Sentences ApiDescription::objections(const Exchange& exchange) const {
  Sentences found = object_to(exchange);
  std::string request = exchange.method;
  request += " " + exchange.target + ", " + std::to_string(exchange.answer.status) + ": ";
  for (std::string& sentence : found) sentence.insert(0, request);
  return found;
}

Sentences ApiDescription::object_to(const Exchange& exchange) const {
  const Answer& answer = exchange.answer;
  Sentences found;
  const std::string path = path_of(exchange.target);
  const bool is_head = exchange.method == "HEAD";
  const std::string method = is_head ? "get" : in_case(exchange.method, std::tolower);
  const Json error = {{"application/json", {{"schema", {{"$ref", "#/components/schemas/Error"}}}}}};
  const std::string type = answer.header("Content-Type").value_or("");
  // What is not described has to be refused, as the description says.
  if (path.empty() || !document_["paths"][path].contains(method)) {
    const int expected = path.empty() ? 404 : 405;
    if (answer.status != expected) found.emplace_back("this request is not described, but it is answered");
    check_body(error, answer.body, type, found);
    return found;
  }
  const Json& operation = document_["paths"][path][method];
  const Json& responses = operation["responses"];
  const std::string status = std::to_string(answer.status);
  if (!responses.contains(status)) {
    found.emplace_back("this status is not described");
    return found;
  }
  const Json& response = resolved(responses[status]);
  check_head(response, answer, found);
  if (is_head && !answer.body.empty()) found.emplace_back("there is a body");
  if (!is_head) check_body(response["content"], answer.body, type, found);
  const bool is_accepted = answer.status < 300;
  if (is_accepted) check_query(exchange, path, found);
  if (is_accepted && operation.contains("requestBody"))
    check_body(operation["requestBody"]["content"], exchange.request_body, "application/json", found);
  return found;
}

void ApiDescription::check_query(const Exchange& exchange, const std::string& path, Sentences& found) const {
  const std::size_t question = exchange.target.find('?');
  if (question == std::string::npos) return;
  const auto known = parameters(path, in_case(exchange.method, std::tolower));
  for (const std::string& part : split(std::string_view(exchange.target).substr(question + 1), '&')) {
    const std::string name = part.substr(0, part.find('='));
    const auto is_it = [&name](const Json& parameter) {
      return parameter["in"] == "query" && parameter["name"] == name;
    };
    if (std::none_of(known.begin(), known.end(), is_it))
      found.push_back("the parameter " + name + " is not described, but it is accepted");
  }
}

void ApiDescription::check_head(const Json& response, const Answer& answer, Sentences& found) const {
  const Json headers = response.value("headers", Json::object());
  for (const auto& [name, header] : headers.items()) {
    if (resolved(header).value("required", false) && !answer.header(name))
      found.push_back("the header " + name + " is missing");
  }
}

void ApiDescription::check_body(const Json& content, const std::string& text, const std::string& type,
                                Sentences& found) const {
  const std::string media = type.substr(0, type.find(';'));
  if (!content.contains(media)) {
    found.push_back("the type \"" + type + "\" is not described");
    return;
  }
  if (media != "application/json") return;
  const Json body = Json::parse(text, nullptr, false);
  if (body.is_discarded()) {
    found.push_back("the body is no JSON: " + text);
    return;
  }
  const Sentences misfit = misfits(content[media]["schema"], body);
  found.insert(found.end(), misfit.begin(), misfit.end());
}

}  // namespace traygauge::test
