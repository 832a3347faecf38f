// Which build of the program this is.
#pragma once

#include <string>

namespace traygauge {

// Such as "0.1.0".
const char* program_version();

// A program says at its start which commit it was built from (firmware/built_commit.hpp); tests do not, so
// that a commit does not link all of them anew. Empty: not known. `commit` outlives the program.
void set_built_commit(const char* commit);
const char* built_commit();

// What `name --version` says: version, commit, build, libraries; a line each, the last without its end.
std::string describe_build(const std::string& name);

}  // namespace traygauge
