#include "firmware/base/build_info.hpp"

namespace traygauge {
namespace {

const char* commit_of_this_build = "";

}  // namespace

const char* program_version() {
  return TRAYGAUGE_VERSION;
}

void set_built_commit(const char* commit) {
  commit_of_this_build = commit;
}

const char* built_commit() {
  return commit_of_this_build;
}

std::string describe_build(const std::string& name) {
  const std::string commit = built_commit();
  return name + " " + program_version() + "\ncommit: " +
         (commit.empty() ? "not known, because it was not built from a git checkout" : commit) +
         "\nbuild: " TRAYGAUGE_BUILD_FACTS "\nbuilt with: " TRAYGAUGE_LIBRARIES;
}

}  // namespace traygauge
