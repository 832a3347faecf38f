// A thin layer over SQLite: statements with typed values, transactions, errors as sentences.
#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "firmware/base/expected.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace traygauge {

class Database;

// Values are counted from 1, columns from 0, as SQLite does.
class Statement {
 public:
  void bind(int index, std::int64_t value);
  template <std::same_as<bool> Flag>  // a text must not become one
  void bind(int index, Flag flag) {
    bind(index, flag ? std::int64_t{1} : std::int64_t{0});
  }
  void bind(int index, double value);
  void bind(int index, std::string_view text);
  void bind(int index, std::nullopt_t);
  template <class Value>
  void bind(int index, const std::optional<Value>& value) {
    if (value.has_value()) {
      bind(index, *value);
    } else {
      bind(index, std::nullopt);
    }
  }
  // As it is, where text would have to be UTF-8.
  void bind_bytes(int index, std::string_view bytes);

  // Whether there is a row to read.
  Expected<bool> step();

  bool is_null(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;  // or bytes
  std::optional<std::int64_t> optional_integer(int column) const;

 private:
  friend class Database;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  Statement(Database& database, std::string attempted, sqlite3_stmt* handle);
  void note(int result);

  Database* database_;
  std::string attempted_;
  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
  int bind_result_ = 0;
};

// One connection; not for several threads at a time. `attempted` is the middle of the sentence that a failure
// tells: "results.db: <attempted>: disk is full".
class Database {
 public:
  // Makes an empty file where there is none. Nothing has been read yet.
  static Expected<std::unique_ptr<Database>> open(const std::filesystem::path& file, const char* vfs_name);
  // A database that is no file, for comparison.
  static Expected<std::unique_ptr<Database>> open_in_memory();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  // Takes the file for this process alone, and sets what database.cpp explains.
  Expected<void> apply_settings();

  const std::filesystem::path& file() const { return file_; }
  // What was found damaged, in SQLite's words; empty as long as nothing was. Then open_store() has to look at
  // the file again.
  const std::string& damage() const { return damage_; }
  Failure note_damage(std::string_view damage);
  // The last failure was a full disk.
  bool was_full() const;
  // The last failure came neither from the disk nor from another process: where a sound statement was to
  // read, the file makes no sense.
  bool was_senseless() const;

  Expected<Statement> prepare(std::string_view attempted, const char* sql);
  // Statements separated by semicolons, without values.
  Expected<void> run_script(std::string_view attempted, const char* sql);

  // Calls on_row(const Statement&) for each row.
  template <class OnRow, class... Values>
  Expected<void> each(std::string_view attempted, const char* sql, OnRow on_row, const Values&... values) {
    Expected<Statement> statement = prepare(attempted, sql);
    if (!statement.ok()) return Failure{statement.failure()};
    int index = 0;
    (statement->bind(++index, values), ...);
    return for_each_row(*statement, on_row);
  }
  template <class OnRow>
  static Expected<void> for_each_row(Statement& statement, OnRow on_row) {
    for (;;) {
      const Expected<bool> row = statement.step();
      if (!row.ok()) return Failure{row.failure()};
      if (!*row) return {};
      on_row(std::as_const(statement));
    }
  }
  template <class... Values>
  Expected<void> execute(std::string_view attempted, const char* sql, const Values&... values) {
    return each(
        attempted, sql, [](const Statement&) {}, values...);
  }
  // The first column of the first row; 0 where there is none.
  template <class... Values>
  Expected<std::int64_t> integer(std::string_view attempted, const char* sql, const Values&... values) {
    std::int64_t value = 0;
    const Expected<void> read = each(
        attempted, sql, [&](const Statement& row) { value = row.integer(0); }, values...);
    if (!read.ok()) return Failure{read.failure()};
    return value;
  }

  // All that the body changes, and all that it reads, is on disk when this returns ok. When it fails, nothing
  // of it is kept, or all where the disk failed in the last moment.
  Expected<void> transaction(std::string_view attempted, const std::function<Expected<void>()>& body);

  std::int64_t last_row() const;
  std::int64_t changed_rows() const;

  // Keeps some room on disk for the journal, so that a full disk does not keep old scans from being deleted.
  // Does nothing where there is none left.
  Expected<void> reserve_journal();

 private:
  friend class Statement;
  struct Close {
    void operator()(sqlite3* handle) const;
  };
  Database(std::filesystem::path file, const char* vfs_name, sqlite3* handle);
  Failure failure(std::string_view attempted, int result);
  Expected<void> settle(std::string_view attempted);
  void roll_back();

  std::filesystem::path file_;
  std::string vfs_name_;
  std::unique_ptr<sqlite3, Close> handle_;
  std::string damage_;
  int last_code_ = 0;
  bool is_in_doubt_ = true;
};

}  // namespace traygauge
