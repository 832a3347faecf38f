#include "tests/firmware/collect/postgres_process.hpp"

#include <libpq-fe.h>
#include <pwd.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>

namespace traygauge::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUser = "postgres";

// Of the newest version; empty where none is installed.
fs::path folder_of_programs() {
  fs::path newest;
  std::error_code ignored;
  for (const auto& version : fs::directory_iterator("/usr/lib/postgresql", ignored)) {
    const fs::path programs = version.path() / "bin";
    if (fs::exists(programs / "initdb") && programs > newest) newest = programs;
  }
  return newest;
}

}  // namespace

bool PostgresProcess::is_installed() {
  return !folder_of_programs().empty();
}

std::vector<std::string> PostgresProcess::as_its_user(std::vector<std::string> arguments) const {
  if (::geteuid() == 0)
    arguments.insert(arguments.begin(), {"/usr/bin/setpriv", "--reuid", kUser, "--regid", kUser,
                                         "--clear-groups", "--pdeathsig", "KILL"});
  return arguments;
}

PostgresProcess::PostgresProcess() {
  if (::geteuid() == 0) {
    const passwd* const user = ::getpwnam(kUser);
    if (user == nullptr || ::chown(folder_.path().c_str(), user->pw_uid, user->pw_gid) != 0)
      throw std::runtime_error("the folder cannot be given to the user postgres");
  }
  LoggedProcess initdb(folder_.path() / "initdb.log");
  initdb.start(
      as_its_user({(folder_of_programs() / "initdb").string(), "-D", (folder_.path() / "data").string(), "-A",
                   "trust", "-U", kUser, "-E", "UTF8", "--no-sync"}));
  if (initdb.end(0) != 0) throw std::runtime_error(initdb.log());
  start();
}

void PostgresProcess::start(const std::vector<std::string>& options) {
  std::vector<std::string> arguments = {(folder_of_programs() / "postgres").string(),
                                        "-D",
                                        (folder_.path() / "data").string(),
                                        "-k",
                                        folder_.path().string(),
                                        "-c",
                                        "listen_addresses="};
  for (const std::string& option : options) arguments.insert(arguments.end(), {"-c", option});
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  process_.start(as_its_user(arguments));
  while (PQping(address().c_str()) != PQPING_OK) {
    if (std::chrono::steady_clock::now() > end) throw std::runtime_error(log());
    // A server that was killed leaves children for a moment; until they are gone the next one does not start.
    if (process_.resident_kib() == 0) {
      process_.end(0);
      process_.start(as_its_user(arguments));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

std::string PostgresProcess::value_of(const std::string& statement) const {
  const std::unique_ptr<PGconn, decltype(&PQfinish)> connection(PQconnectdb(address().c_str()), PQfinish);
  const std::unique_ptr<PGresult, decltype(&PQclear)> result(PQexec(connection.get(), statement.c_str()),
                                                             PQclear);
  return PQntuples(result.get()) == 1 ? PQgetvalue(result.get(), 0, 0) : "";
}

}  // namespace traygauge::test
