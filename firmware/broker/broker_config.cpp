#include "firmware/broker/broker_config.hpp"

#include <algorithm>

#include "firmware/broker/topic.hpp"

namespace traygauge {
namespace {

constexpr std::uint16_t kEncryptedPort = 8883;
constexpr std::uint16_t kPlainPort = 1883;
constexpr int kLastPort = 65535;
constexpr std::size_t kLongestHost = 253;
constexpr std::size_t kLongestUser = 128;

bool is_host(std::string_view text) {
  return text.size() <= kLongestHost && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                  std::string_view(".-_:").find(c) != std::string_view::npos;
         });
}

bool is_visible_text(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < '\x7f'; });
}

void need_beside(const std::optional<JsonNode>& node, const std::optional<JsonNode>& other,
                 const char* name) {
  if (node && !other)
    node->fail(std::string("the key ") + name + " beside this one", "add it, or remove this one");
}

void read_access(const JsonNode& table, const std::filesystem::path& folder, BrokerConfig& config) {
  const auto certificate = table.find("certificate");
  const auto key = table.find("certificate_key");
  need_beside(certificate, key, "certificate_key");
  need_beside(key, certificate, "certificate");
  if (certificate) config.certificate = folder / certificate->text();
  if (key) config.certificate_key = folder / key->text();
  const auto user = table.find("user");
  const auto password = table.find("password_file");
  need_beside(password, user, "user");
  if (password) config.password_file = folder / password->text();
  if (!user) return;
  config.user = user->text();
  if (config.user.size() > kLongestUser || !is_visible_text(config.user))
    user->fail("at most 128 visible characters without spaces", "correct the value");
}

}  // namespace

std::string BrokerConfig::shown() const {
  const bool is_literal = host.find(':') != std::string::npos;
  return std::string(is_encrypted ? "mqtts://" : "mqtt://") + (is_literal ? "[" + host + "]" : host) + ":" +
         std::to_string(port);
}

const std::vector<std::string_view>& broker_keys() {
  static const std::vector<std::string_view> keys{
      "host", "port", "tls", "ca", "certificate", "certificate_key", "user", "password_file", "prefix"};
  return keys;
}

BrokerConfig read_broker_keys(const JsonNode& table, const std::string& name,
                              const std::filesystem::path& folder) {
  BrokerConfig config;
  config.table = name;
  const JsonNode host = table.member("host");
  config.host = host.text();
  if (!is_host(config.host))
    host.fail(R"(a name or an address such as "broker.example", without scheme and port)",
              "write the port to the key port");
  if (const auto tls = table.find("tls")) config.is_encrypted = tls->truth();
  config.port = config.is_encrypted ? kEncryptedPort : kPlainPort;
  if (const auto port = table.find("port"))
    config.port = static_cast<std::uint16_t>(port->integer(1, kLastPort));
  if (const auto trusted = table.find("ca")) config.trusted = folder / trusted->text();
  read_access(table, folder, config);
  for (const char* const key : {"ca", "certificate", "certificate_key"}) {
    const auto node = table.find(key);
    if (node && !config.is_encrypted) node->fail("no such key where tls is false", "remove one of the two");
  }
  if (const auto prefix = table.find("prefix")) {
    config.prefix = prefix->text();
    if (!is_topic_prefix(config.prefix))
      prefix->fail("levels of a-z, A-Z, 0-9, '-' and '_' with '/' between them, at most 64 characters",
                   "correct the value");
  }
  return config;
}

}  // namespace traygauge
