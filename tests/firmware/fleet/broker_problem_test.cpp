// How a broker's problem is told.
#include "firmware/broker/broker_problem.hpp"

#include <gtest/gtest.h>
#include <mosquitto.h>

#include <cerrno>
#include <string>

#include "firmware/broker/broker_config.hpp"

namespace traygauge {
namespace {

// Which of the two is seen depends on whether the client reads or writes first.
TEST(BrokerProblem, ABrokerThatClosesIsToldAlikeWhoeverSeesIt) {
  BrokerConfig config;
  config.table = "fleet";
  config.host = "broker.example";
  for (const bool was_connected : {false, true}) {
    BrokerProblem read;
    read.was_connected = was_connected;
    read.result = MOSQ_ERR_CONN_LOST;
    BrokerProblem written = read;
    written.result = MOSQ_ERR_ERRNO;
    written.system_error = EPIPE;
    const std::string told = describe(read, config, "traygauge-kitchen");
    EXPECT_NE(told.find("closed the connection"), std::string::npos) << told;
    EXPECT_EQ(describe(written, config, "traygauge-kitchen"), told);
    written.system_error = ECONNREFUSED;
    EXPECT_NE(describe(written, config, "traygauge-kitchen"), told);
  }
}

}  // namespace
}  // namespace traygauge
