// SPDX-License-Identifier: Apache-2.0
#include "io/ledger.h"

#include "io/dependencies.h"

#include <sqlite3.h>

#include <cerrno>
#include <memory>
#include <system_error>

namespace vitrine::io {
namespace {

namespace fs = std::filesystem;

constexpr int kSchema = 1;

/// A prepared statement that is finished on every way out.
class Statement {
 public:
  Statement(sqlite3* database, char const* sql) { sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr); }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(Statement const&) = delete;
  Statement& operator=(Statement const&) = delete;

  void bind(int place, std::string const& bytes) {
    if (statement_) sqlite3_bind_blob64(statement_, place, bytes.data(), bytes.size(), SQLITE_STATIC);
  }
  int step() { return statement_ ? sqlite3_step(statement_) : SQLITE_ERROR; }
  std::string bytes(int column) const {
    auto const* data = static_cast<char const*>(sqlite3_column_blob(statement_, column));
    return data ? std::string(data, std::size_t(sqlite3_column_bytes(statement_, column))) : std::string();
  }
  int number(int column) const { return sqlite3_column_int(statement_, column); }

 private:
  sqlite3_stmt* statement_ = nullptr;
};

/// As the system would say it.
int reason(int code) {
  switch (code & 0xff) {
    case SQLITE_FULL:
      return ENOSPC;
    case SQLITE_READONLY:
      return EROFS;
    case SQLITE_PERM:
    case SQLITE_AUTH:
      return EACCES;
    case SQLITE_NOMEM:
      return ENOMEM;
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return EBUSY;
    default:
      return EIO;
  }
}

std::map<std::string, std::string> all_entries(sqlite3* database) {
  std::map<std::string, std::string> found;
  Statement all(database, "SELECT slug, entry, sum FROM models");
  while (all.step() == SQLITE_ROW) {
    std::string slug = all.bytes(0), entry = all.bytes(1);
    if (content_hash(slug + entry) == all.bytes(2)) found.emplace(std::move(slug), std::move(entry));
  }
  return found;
}

void remove_database(fs::path const& file) {
  std::error_code ignored;
  for (char const* part : {"", "-wal", "-shm"}) fs::remove(file.string() + part, ignored);
}

}  // namespace

void Ledger::Close::operator()(sqlite3* database) const { sqlite3_close(database); }

void Ledger::fail() const {
  int const code = database_ ? sqlite3_extended_errcode(database_.get()) : SQLITE_CANTOPEN;
  int const system = database_ ? sqlite3_system_errno(database_.get()) : 0;
  throw fs::filesystem_error("cannot keep the ledger", file_,
                             std::error_code(system ? system : reason(code), std::generic_category()));
}

void Ledger::run(char const* sql) const {
  if (sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

/// Whether it can be used as it is.
bool Ledger::try_open() {
  sqlite3* opened = nullptr;
  int const code = sqlite3_open_v2(file_.c_str(), &opened, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  database_.reset(opened);
  if (code != SQLITE_OK) return false;
  sqlite3_busy_timeout(opened, 10'000);
  Statement version(opened, "PRAGMA user_version");
  if (version.step() != SQLITE_ROW || version.number(0) != kSchema) return false;
  Statement check(opened, "PRAGMA quick_check(1)");
  return check.step() == SQLITE_ROW && check.bytes(0) == "ok";
}

Ledger::Ledger(fs::path const& file) : file_(file) {
  fs::create_directories(file.parent_path());
  if (!try_open()) {
    begun_anew_ = true;
    database_.reset();
    remove_database(file);
    sqlite3* opened = nullptr;
    int const code = sqlite3_open(file.c_str(), &opened);
    database_.reset(opened);
    if (code != SQLITE_OK) fail();
    run("CREATE TABLE models (slug BLOB PRIMARY KEY, entry BLOB NOT NULL, sum BLOB NOT NULL) WITHOUT ROWID;"
        "PRAGMA user_version = 1");
  }
  run("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL");
}

std::map<std::string, std::string> Ledger::entries() const { return all_entries(database_.get()); }

void Ledger::put(std::string const& slug, std::string const& entry) {
  std::string const sum = content_hash(slug + entry);
  Statement statement(database_.get(), "INSERT OR REPLACE INTO models VALUES (?, ?, ?)");
  statement.bind(1, slug);
  statement.bind(2, entry);
  statement.bind(3, sum);
  if (statement.step() != SQLITE_DONE) fail();
}

void Ledger::erase(std::string const& slug) {
  Statement statement(database_.get(), "DELETE FROM models WHERE slug = ?");
  statement.bind(1, slug);
  if (statement.step() != SQLITE_DONE) fail();
}

std::map<std::string, std::string> read_ledger(fs::path const& file) {
  sqlite3* opened = nullptr;
  int const code = sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> const database(opened, sqlite3_close);
  if (code != SQLITE_OK) return {};
  sqlite3_busy_timeout(opened, 10'000);
  Statement version(opened, "PRAGMA user_version");
  if (version.step() != SQLITE_ROW || version.number(0) != kSchema) return {};
  return all_entries(opened);
}

}  // namespace vitrine::io
