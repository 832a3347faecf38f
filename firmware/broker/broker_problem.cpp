#include "firmware/broker/broker_problem.hpp"

#include <mosquitto.h>

#include <cerrno>
#include <system_error>

#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

// MQTT 3.1.1, 3.2.2.3.
constexpr int kProtocol = 1;
constexpr int kIdentifier = 2;
constexpr int kUnavailable = 3;
constexpr int kPassword = 4;
constexpr int kNotAuthorised = 5;

std::string describe_refusal(int refusal, const BrokerConfig& config, const std::string& client_id) {
  switch (refusal) {
    case kProtocol:
      return " does not speak MQTT 3.1.1.";
    case kIdentifier:
      return " does not take a client called " + client_id + ".";
    case kUnavailable:
      return " says that it is out of service.";
    case kPassword:
    case kNotAuthorised:
      if (config.user.empty() && !config.certificate)
        return " takes nobody without a user; set " + config.table + ".user and " + config.table +
               ".password_file.";
      return " refuses this client; correct " +
             (config.user.empty() ? config.table + ".certificate"
                                  : config.table + ".user or " + config.table + ".password_file") +
             ", or what the broker knows of it.";
    default:
      return " answered something that is not MQTT 3.1.1.";
  }
}

// TLS alerts come as the text of OpenSSL.
bool is_alert(const std::string& detail) {
  return detail.find("alert") != std::string::npos;
}

std::string with_detail(const BrokerProblem& problem) {
  return problem.detail.empty() ? std::string(".") : " (" + printable(problem.detail) + ").";
}

// A client that writes before it has read that the other end is closed gets EPIPE.
bool is_closed_by_broker(const BrokerProblem& problem) {
  return problem.result == MOSQ_ERR_CONN_LOST ||
         (problem.result == MOSQ_ERR_ERRNO && problem.system_error == EPIPE);
}

}  // namespace

std::string describe(const BrokerProblem& problem, const BrokerConfig& config, const std::string& client_id) {
  const std::string broker = config.shown();
  if (!problem.distrust.empty())
    return "The certificate of " + broker + " is not trusted (" + problem.distrust +
           "); correct it, or name its authority's certificate in " + config.table + ".ca.";
  if (problem.refusal != 0) return broker + describe_refusal(problem.refusal, config, client_id);
  if (is_alert(problem.detail) && !problem.own_end.empty()) return problem.own_end;
  if (is_alert(problem.detail))
    return broker + " refuses this client's certificate" + with_detail(problem) + " Correct " + config.table +
           ".certificate.";
  if (is_closed_by_broker(problem))
    return broker + (problem.was_connected
                         ? " closed the connection. Where it does so again and again, another client may be "
                           "called " +
                               client_id + ", too."
                         : " closed the connection without an answer.");
  switch (problem.result) {
    case MOSQ_ERR_ACL_DENIED:
      return broker +
             " does not let this client listen to its topics; where that lasts, correct the rules of the "
             "broker.";
    case MOSQ_ERR_TLS:
      return broker + " does not speak TLS 1.2 or later" + with_detail(problem);
    case MOSQ_ERR_PROTOCOL:
    case MOSQ_ERR_MALFORMED_PACKET:
    case MOSQ_ERR_MALFORMED_UTF8:
    case MOSQ_ERR_NOT_SUPPORTED:
    case MOSQ_ERR_INVAL:
      return broker + " answered something that is not MQTT 3.1.1.";
    case MOSQ_ERR_KEEPALIVE:
      return broker + " has not answered for a while.";
    case MOSQ_ERR_ERRNO:
      if (problem.system_error != 0)
        return broker + (problem.was_connected ? " was lost (" : " takes no connection (") +
               std::system_category().message(problem.system_error) + ").";
      break;
    default:
      break;
  }
  return broker + " cannot be used: " + mosquitto_strerror(problem.result) + with_detail(problem);
}

bool is_refusal(const BrokerProblem& problem) {
  if (!problem.distrust.empty() || is_alert(problem.detail)) return true;
  // A cluster whose nodes come and go also says so of subscriptions that it takes a moment later.
  return problem.refusal != 0 && problem.refusal != kUnavailable;
}

}  // namespace traygauge
