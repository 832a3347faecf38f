// Programs that lie beside this one: what they load, a station need not.
#pragma once

#include <string>
#include <vector>

namespace traygauge {

// Where it lies, if it is there.
std::string sibling_path(const std::string& name);

// Runs it with these arguments, on this program's streams, and returns its exit status. Throws UsageError
// when it is not there.
int run_sibling_program(const std::string& name, const std::vector<std::string>& arguments);

// Goes on as that program, with these arguments, a null at their end. Returns only when it is not there.
void become_sibling_program(const std::string& name, char* const* arguments);

}  // namespace traygauge
