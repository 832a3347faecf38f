#include "tests/firmware/api/token_files.hpp"

#include <sys/stat.h>

#include <fstream>

namespace traygauge::test {

TokenFiles::TokenFiles() {
  write("view", kView);
  write("manage", std::string(kManage) + " ann");
}

WebConfig TokenFiles::config() const {
  WebConfig config;
  config.view_tokens = folder_.path() / "view";
  config.manage_tokens = folder_.path() / "manage";
  return config;
}

std::string TokenFiles::bearer(const std::string& token) {
  return "Authorization: Bearer " + token + "\r\n";
}

void TokenFiles::write(const std::string& name, const std::string& line) const {
  const std::filesystem::path file = folder_.path() / name;
  std::ofstream(file) << line << "\n";
  ::chmod(file.c_str(), 0600);  // others' eyes make it worthless
}

}  // namespace traygauge::test
