#include "firmware/base/secret_file.hpp"
#include "firmware/broker/broker_link.hpp"

namespace traygauge {

Expected<std::string> read_broker_password(const BrokerConfig& config) {
  return read_password_file(config.password_file->string(), config.table + ".password_file");
}

}  // namespace traygauge
