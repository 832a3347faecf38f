// Why there is no connection to a broker, in words for people.
#pragma once

#include <string>

#include "firmware/broker/broker_config.hpp"

namespace traygauge {

struct BrokerProblem {
  int result = 0;              // libmosquitto's
  int system_error = 0;        // an errno, where the result says that there is one
  int refusal = 0;             // the code of MQTT by which the broker refused the client; 0: it did not
  bool was_connected = false;  // it took the client before
  std::string detail;          // libmosquitto's last complaint
  std::string distrust;        // why the broker's certificate is not believed
  std::string own_end;         // a sentence: this program's certificate has ended
};

// Has neither user nor password.
std::string describe(const BrokerProblem& problem, const BrokerConfig& config, const std::string& client_id);

// Whether trying soon cannot help.
bool is_refusal(const BrokerProblem& problem);

}  // namespace traygauge
