// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is known of each model, kept between runs: an SQLite database (write-ahead log), written by one process.
///
/// A cache: what stands in certificates can be read from them again, so a ledger that is missing, damaged or of another
/// schema is begun anew. A commit that a power failure takes back costs a second look at a certificate, nothing else.

#include <filesystem>
#include <map>
#include <memory>
#include <string>

struct sqlite3;

namespace vitrine::io {

class Ledger {
 public:
  /// Opens or makes it. Errors: std::filesystem::filesystem_error when there can be none (full disk, no permission).
  explicit Ledger(std::filesystem::path const& file);

  bool begun_anew() const { return begun_anew_; }  ///< no ledger was there, or none that can be used

  /// By slug. Entries whose bytes do not fit their checksum are left out.
  std::map<std::string, std::string> entries() const;
  /// Any bytes. Durable against a crash of this process on return. Errors: as the constructor.
  void put(std::string const& slug, std::string const& entry);
  void erase(std::string const& slug);

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  bool try_open();
  void run(char const* sql) const;
  [[noreturn]] void fail() const;

  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> database_;
  bool begun_anew_ = false;
};

/// The entries of a ledger that somebody else may be writing; none where there is no ledger, or none that can be read.
std::map<std::string, std::string> read_ledger(std::filesystem::path const& file);

}  // namespace vitrine::io
