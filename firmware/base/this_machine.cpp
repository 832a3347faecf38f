#include "firmware/base/this_machine.hpp"

namespace traygauge {

bool is_this_machine(std::string_view host) {
  if (host == "localhost" || host.ends_with(".localhost") || host == "::1") return true;
  return host.starts_with("127.") && host.find_first_not_of("0123456789.") == std::string_view::npos;
}

}  // namespace traygauge
