// Why a message got no answer, in words for people.
#pragma once

#include <curl/curl.h>

#include <string>

namespace traygauge {

struct SendProblem {
  CURLcode code = CURLE_OK;
  std::string detail;          // libcurl's, which names host and port at most
  std::string receiver;        // what to call it
  int system_error = 0;        // an errno, where the system refused; 0: it did not
  bool was_connected = false;  // TLS included
  bool is_too_long = false;    // its answer
};

// Has neither the address's path nor its query.
std::string describe(const SendProblem& problem);

}  // namespace traygauge
