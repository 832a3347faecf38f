#include "firmware/collect/postgres_store.hpp"

#include <libpq-fe.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "firmware/base/secret_file.hpp"

namespace traygauge {
namespace {

constexpr const char* kTablesVersion = "1";
// Under a lock, so that collectors that start at once make the tables one after the other. Its number is any.
constexpr const char* kMakeTables =
    "BEGIN;"
    "SELECT pg_advisory_xact_lock(5283459176203);"
    "CREATE TABLE IF NOT EXISTS traygauge_version (version INTEGER NOT NULL);"
    "INSERT INTO traygauge_version SELECT 1 WHERE NOT EXISTS (SELECT 1 FROM traygauge_version);"
    "CREATE TABLE IF NOT EXISTS events (seq BIGINT GENERATED ALWAYS AS IDENTITY PRIMARY KEY, id TEXT NOT "
    "NULL UNIQUE,"
    " hub TEXT NOT NULL, station TEXT NOT NULL, kind TEXT NOT NULL, taken_at TEXT NOT NULL,"
    " received_ms BIGINT NOT NULL, body TEXT NOT NULL);"
    "CREATE TABLE IF NOT EXISTS twins (id TEXT NOT NULL, hub TEXT NOT NULL, taken_at TEXT NOT NULL,"
    " received_ms BIGINT NOT NULL, body TEXT NOT NULL, UNIQUE (id, hub, taken_at));"
    "COMMIT";
// A receipt says that an event is on disk, so each commit of ours waits for it, whatever the server does for
// others.
constexpr const char* kSession =
    "SET client_min_messages = error;"
    "SET statement_timeout = '20s';"
    "SELECT set_config('synchronous_commit', 'on', false)"
    " WHERE current_setting('synchronous_commit') IN ('off', 'local')";

struct Clear {
  void operator()(PGresult* result) const { PQclear(result); }
};
using Result = std::unique_ptr<PGresult, Clear>;

bool is_good(const Result& result) {
  const ExecStatusType status = PQresultStatus(result.get());
  return status == PGRES_COMMAND_OK || status == PGRES_TUPLES_OK;
}

// libpq's words, on one line.
std::string reason_of(const PGconn* connection) {
  std::string text = PQerrorMessage(connection);
  std::ranges::replace(text, '\n', ' ');
  text.erase(text.find_last_not_of(' ') + 1);
  return text.empty() ? "no memory" : text;
}

Failure failure_of(const StoreConfig& config, const PGconn* connection) {
  return Failure{config.shown() + ": " + reason_of(connection)};
}

// PostgreSQL's texts cannot hold a NUL, those of a hub might.
std::string storable(std::string text) {
  constexpr const char* kReplacement = "\xEF\xBF\xBD";
  for (std::size_t at = 0; (at = text.find('\0', at)) != std::string::npos;)
    text.replace(at, 1, kReplacement);
  return text;
}

// An array of texts as PostgreSQL reads it.
class TextArray {
 public:
  void add(const std::string& text) {
    text_ += text_.size() > 1 ? ",\"" : "\"";
    for (const char c : storable(text)) {
      if (c == '"' || c == '\\') text_ += '\\';
      text_ += c;
    }
    text_ += '"';
  }
  std::string finished() const { return text_ + "}"; }

 private:
  std::string text_ = "{";
};

template <std::size_t N>
Result run(PGconn* connection, const char* statement, const std::array<std::string, N>& values) {
  std::array<const char*, N> pointers{};
  std::ranges::transform(values, pointers.begin(), [](const std::string& value) { return value.c_str(); });
  return Result(PQexecParams(connection, statement, static_cast<int>(N), nullptr, pointers.data(), nullptr,
                             nullptr, 0));
}

// id, hub and time: what makes a tray that tray.
using Tray = std::tuple<std::string, std::string, std::string>;

Tray tray_of(const CollectedEvent& event) {
  return {storable(event.id), storable(event.hub), storable(event.taken_at)};
}

std::string field(const Result& result, int row, int column) {
  return PQgetvalue(result.get(), row, column);
}

Tray tray_of(const Result& result, int row) {
  return {field(result, row, 0), field(result, row, 1), field(result, row, 2)};
}

// Says nothing of the address where it may hold a password.
Expected<void> check_address(const std::string& address) {
  char* problem = nullptr;
  const std::unique_ptr<PQconninfoOption, decltype(&PQconninfoFree)> options(
      PQconninfoParse(address.c_str(), &problem), PQconninfoFree);
  if (problem != nullptr) PQfreemem(problem);
  if (!options)
    return Failure{"store: expected postgresql://USER@HOST/DATABASE, found what is no such address"};
  for (const PQconninfoOption* option = options.get(); option->keyword != nullptr; ++option) {
    if (std::string_view(option->keyword) == "password" && option->val != nullptr)
      return Failure{
          "store: expected an address without a password; write it into a file and name that as "
          "store_password_file"};
  }
  return {};
}

}  // namespace

void PostgresStore::Finish::operator()(pg_conn* connection) const {
  PQfinish(connection);
}

Expected<std::unique_ptr<CollectedStore>> PostgresStore::open(const StoreConfig& config) {
  if (const Expected<void> checked = check_address(config.database); !checked.ok())
    return Failure{checked.failure()};
  std::unique_ptr<PostgresStore> store(new PostgresStore(config));
  if (const Expected<void> connected = store->connect(); !connected.ok()) return Failure{connected.failure()};
  return std::unique_ptr<CollectedStore>(std::move(store));
}

Expected<void> PostgresStore::connect() {
  // Values of the address win over those before it, but for the password, which it cannot hold.
  std::string password;
  if (config_.password) {
    Expected<std::string> read = read_password_file(config_.password->string(), "store_password_file");
    if (!read.ok()) return Failure{read.failure()};
    password = std::move(*read);
  }
  const std::array<const char*, 8> keys = {
      "connect_timeout",           "tcp_user_timeout", "keepalives_idle", "client_encoding",
      "fallback_application_name", "password",         "dbname",          nullptr};
  const std::array<const char*, 8> values = {"8",
                                             "15000",
                                             "30",
                                             "UTF8",
                                             "traygauge-collect",
                                             password.empty() ? nullptr : password.c_str(),
                                             config_.database.c_str(),
                                             nullptr};
  connection_.reset(PQconnectdbParams(keys.data(), values.data(), 1));
  if (PQstatus(connection_.get()) != CONNECTION_OK) return failure_of(config_, connection_.get());
  return prepare();
}

Expected<void> PostgresStore::prepare() {
  for (const char* const script : {kSession, kMakeTables}) {
    if (!is_good(Result(PQexec(connection_.get(), script)))) return failure_of(config_, connection_.get());
  }
  const Result version(
      PQexec(connection_.get(), "SELECT max(version), current_setting('fsync') FROM traygauge_version"));
  if (!is_good(version)) return failure_of(config_, connection_.get());
  if (field(version, 0, 1) != "on")
    return Failure{config_.shown() +
                   ": expected a server that writes to disk, found fsync off: a power cut would lose what "
                   "hubs have forgotten. Turn it on."};
  if (field(version, 0, 0) == kTablesVersion) return {};
  return Failure{config_.shown() + ": expected tables of version " + kTablesVersion + ", found " +
                 field(version, 0, 0) + "; install the newer program again."};
}

Expected<StoredBatch> PostgresStore::put(std::span<const CollectedEvent> events, std::int64_t received_ms) {
  if (PQstatus(connection_.get()) != CONNECTION_OK) {
    if (const Expected<void> connected = connect(); !connected.ok()) return Failure{connected.failure()};
  }
  Expected<StoredBatch> batch = put_all(events, received_ms);
  // A commit whose answer was lost may have been done: hubs send again, and it is found then.
  if (!batch.ok() && PQstatus(connection_.get()) == CONNECTION_OK)
    Result(PQexec(connection_.get(), "ROLLBACK"));
  return batch;
}

Expected<StoredBatch> PostgresStore::put_all(std::span<const CollectedEvent> events,
                                             std::int64_t received_ms) {
  PGconn* const connection = connection_.get();
  if (!is_good(Result(PQexec(connection, "BEGIN")))) return failure_of(config_, connection);
  std::array<TextArray, 6> columns;
  for (const CollectedEvent& event : events) {
    const std::array<const std::string*, 6> texts = {&event.id,   &event.hub,      &event.station,
                                                     &event.kind, &event.taken_at, &event.body};
    for (std::size_t i = 0; i < texts.size(); ++i) columns[i].add(*texts[i]);
  }
  const Result inserted =
      run<7>(connection,
             "INSERT INTO events (id, hub, station, kind, taken_at, body, received_ms)"
             " SELECT id, hub, station, kind, taken_at, body, $7::bigint FROM"
             " unnest($1::text[], $2::text[], $3::text[], $4::text[], $5::text[], $6::text[])"
             " AS given (id, hub, station, kind, taken_at, body) ORDER BY id"
             " ON CONFLICT (id) DO NOTHING RETURNING id, hub, taken_at",
             {columns[0].finished(), columns[1].finished(), columns[2].finished(), columns[3].finished(),
              columns[4].finished(), columns[5].finished(), std::to_string(received_ms)});
  if (!is_good(inserted)) return failure_of(config_, connection);
  StoredBatch batch;
  std::map<Tray, bool> is_new;
  for (int row = 0; row < PQntuples(inserted.get()); ++row) is_new[tray_of(inserted, row)] = true;
  std::vector<CollectedEvent> again;
  for (const CollectedEvent& event : events) {
    const auto found = is_new.find(tray_of(event));
    if (found != is_new.end() && std::exchange(found->second, false)) {
      ++batch.stored;
    } else {
      again.push_back(event);
    }
  }
  if (const Expected<void> put = put_again(again, received_ms, batch); !put.ok())
    return Failure{put.failure()};
  if (!is_good(Result(PQexec(connection, "COMMIT")))) return failure_of(config_, connection);
  return batch;
}

// Those whose id is there already.
Expected<void> PostgresStore::put_again(std::span<const CollectedEvent> events, std::int64_t received_ms,
                                        StoredBatch& batch) {
  if (events.empty()) return {};
  PGconn* const connection = connection_.get();
  TextArray ids;
  for (const CollectedEvent& event : events) ids.add(event.id);
  const Result there = run<1>(connection, "SELECT id, hub, taken_at FROM events WHERE id = ANY ($1::text[])",
                              {ids.finished()});
  if (!is_good(there)) return failure_of(config_, connection);
  std::set<Tray> known;
  for (int row = 0; row < PQntuples(there.get()); ++row) known.insert(tray_of(there, row));
  for (const CollectedEvent& event : events) {
    if (known.contains(tray_of(event))) {
      ++batch.repeated;
      continue;
    }
    const Result twin = run<5>(connection,
                               "INSERT INTO twins (id, hub, taken_at, received_ms, body)"
                               " VALUES ($1, $2, $3, $4::bigint, $5) ON CONFLICT DO NOTHING",
                               {storable(event.id), storable(event.hub), storable(event.taken_at),
                                std::to_string(received_ms), storable(event.body)});
    if (!is_good(twin)) return failure_of(config_, connection);
    if (std::string_view(PQcmdTuples(twin.get())) == "1") {
      batch.twins.push_back(event.id);
    } else {
      ++batch.repeated;
    }
  }
  return {};
}

Expected<std::int64_t> PostgresStore::count() {
  const Result counted(PQexec(connection_.get(), "SELECT count(*) FROM events"));
  if (!is_good(counted)) return failure_of(config_, connection_.get());
  return std::stoll(field(counted, 0, 0));
}

}  // namespace traygauge
