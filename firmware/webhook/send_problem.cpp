#include "firmware/webhook/send_problem.hpp"

#include <system_error>

namespace traygauge {

std::string describe(const SendProblem& problem) {
  const std::string& receiver = problem.receiver;
  if (problem.is_too_long) return receiver + " answered with a head longer than 64 kB.";
  switch (problem.code) {
    case CURLE_COULDNT_RESOLVE_HOST:
      return "The name in " + receiver + " cannot be looked up; check the address and the name server.";
    case CURLE_COULDNT_CONNECT:
      return receiver + " takes no connection" +
             (problem.system_error != 0 ? " (" + std::system_category().message(problem.system_error) + ")."
                                        : ".");
    case CURLE_OPERATION_TIMEDOUT:
      return problem.was_connected ? receiver + " took the message and did not answer in time."
                                   : receiver + " could not be reached in time.";
    case CURLE_PEER_FAILED_VERIFICATION:
      return "The certificate of " + receiver + " is not trusted (" + problem.detail +
             "); name the authority's certificate in webhook_ca.";
    case CURLE_SSL_CACERT_BADFILE:
      return "The file webhook_ca cannot be used; expected certificates in PEM.";
    case CURLE_OK:  // within its answer
    case CURLE_GOT_NOTHING:
    case CURLE_RECV_ERROR:
    case CURLE_SEND_ERROR:
    case CURLE_PARTIAL_FILE:
      return receiver + " closed the connection without a whole answer.";
    case CURLE_UNSUPPORTED_PROTOCOL:
    case CURLE_WEIRD_SERVER_REPLY:
      return receiver + " answered something that is not HTTP.";
    case CURLE_SSL_CONNECT_ERROR:
      return receiver + " does not speak TLS 1.2 or later (" + problem.detail + ").";
    default:
      return receiver + " cannot be told: " + curl_easy_strerror(problem.code) + ".";
  }
}

}  // namespace traygauge
