// SPDX-License-Identifier: Apache-2.0
#include "io/archive.h"

#include "io/csv.h"
#include "io/glob.h"
#include "io/read_model.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cstdio>
#include <system_error>

namespace vitrine::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kCatalogue = "archive.csv";

std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

bool is_model(fs::path const& file) {
  std::string const ending = lower_case(file.extension().string());
  std::span<Format const> const known = formats();
  return std::any_of(known.begin(), known.end(), [&](Format const& f) { return f.ending == ending; });
}

/// Letters and digits of the path without its ending, the last 60 where there are more, and the path's hash.
std::string slug_of(std::string const& path) {
  std::string slug;
  for (char const c : lower_case(fs::path(path).replace_extension().generic_string())) {
    bool const plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (plain)
      slug += c;
    else if (!slug.empty() && slug.back() != '-')
      slug += '-';
  }
  if (slug.size() > 60) slug.erase(0, slug.size() - 60);
  while (slug.starts_with('-')) slug.erase(0, 1);
  while (slug.ends_with('-')) slug.pop_back();
  char hash[10];
  std::snprintf(hash, sizeof hash, "-%08x", static_cast<unsigned>(XXH3_64bits(path.data(), path.size()) & 0xFFFFFFFF));
  return (slug.empty() ? "model" : slug) + hash;
}

/// Finds the models below the root, in the order of the file system.
class Walk {
 public:
  Walk(fs::path root, ArchiveOptions const& options, Archive& archive)
      : root_(fs::canonical(root)), options_(options), archive_(archive) {}

  void run() { folder(root_, ""); }

 private:
  void note(std::string const& path, std::string const& what) { archive_.notes.push_back(path + ": " + what); }

  void folder(fs::path const& place, std::string const& prefix) {
    std::error_code error;
    for (fs::directory_iterator it(place, error), end; !error && it != end; it.increment(error)) {
      std::string const name = it->path().filename().string();
      if (!name.starts_with('.')) visit(it->path(), prefix + name);
    }
    if (error) note(prefix.empty() ? "." : prefix, "cannot be read: " + error.message());
  }

  void visit(fs::path const& place, std::string const& path) {
    std::error_code error;
    fs::file_type const type = fs::symlink_status(place, error).type();
    if (type == fs::file_type::symlink) return link(place, path);
    if (type == fs::file_type::directory) {
      if (!fs::exists(place / ".vitrine", error)) folder(place, path + "/");  // a gallery's thumbnails are no originals
    } else if (type == fs::file_type::regular) {
      if (is_model(place)) add(place, path);
    } else {
      note(path, "passed over: neither a file nor a folder");
    }
  }

  /// Links to files of the archive are models like others; folders are walked where they are.
  void link(fs::path const& place, std::string const& path) {
    std::error_code error;
    fs::path const target = fs::canonical(place, error);
    if (error) return note(path, "passed over: the link leads nowhere");
    if (std::mismatch(root_.begin(), root_.end(), target.begin(), target.end()).first != root_.end())
      return note(path, "passed over: the link leads out of the archive");
    if (fs::is_directory(target, error)) return note(path, "passed over: a link to a folder of the archive");
    if (fs::is_regular_file(target, error) && is_model(place)) add(place, path);
  }

  void add(fs::path const& place, std::string const& path) {
    auto const matches = [&](std::string const& pattern) { return matches_glob(pattern, path); };
    bool const wanted =
        options_.include.empty() || std::any_of(options_.include.begin(), options_.include.end(), matches);
    if (!wanted || std::any_of(options_.exclude.begin(), options_.exclude.end(), matches)) return;
    std::error_code error;
    std::uint64_t const bytes = fs::file_size(place, error);
    archive_.entries.push_back({path, place, error ? 0 : bytes, slug_of(path), options_.up, {}});
  }

  fs::path root_;
  ArchiveOptions const& options_;
  Archive& archive_;
};

[[noreturn]] void refuse(std::uint64_t line, std::string const& what) {
  throw Error(ErrorKind::invalid_input, std::string(kCatalogue) + " line " + std::to_string(line) + ": " + what,
              "correct the table, or take it out of the archive");
}

UpAxis up_axis(CsvRow const& row, std::string const& cell) {
  std::string const axis = lower_case(cell);
  if (axis == "y") return UpAxis::y;
  if (axis == "z") return UpAxis::z;
  refuse(row.line, "up is \"" + cell.substr(0, 20) + "\", which is neither y nor z");
}

/// The path as the walk spells it.
std::string normal_path(std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  return fs::path(path).lexically_normal().generic_string();
}

/// Gives an entry the cells of its row.
void describe(ArchiveEntry& entry, CsvRow const& heading, CsvRow const& row) {
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    std::string const& column = heading.cells[i];
    if (column == "path" || row.cells[i].empty()) continue;
    if (column == "up")
      entry.up = up_axis(row, row.cells[i]);
    else
      entry.metadata[column] = row.cells[i];
  }
}

void read_catalogue(fs::path const& file, Archive& archive) {
  Blob const blob = map_file(file);
  std::vector<CsvRow> rows;
  try {
    rows = parse_csv(text(blob));
  } catch (Error const& error) {
    throw Error(error.kind(), std::string(kCatalogue) + " " + error.what(), error.remedy());
  }
  if (rows.empty()) refuse(1, "the table is empty");
  CsvRow& heading = rows.front();
  for (std::string& column : heading.cells) column = lower_case(column);
  auto const path_column = std::find(heading.cells.begin(), heading.cells.end(), "path");
  if (path_column == heading.cells.end()) refuse(heading.line, "no column is named path");
  auto const at = static_cast<std::size_t>(path_column - heading.cells.begin());
  for (CsvRow const& row : std::span(rows).subspan(1)) {
    if (row.cells.size() > heading.cells.size())
      refuse(row.line,
             std::to_string(row.cells.size()) + " cells under " + std::to_string(heading.cells.size()) + " headings");
    std::string const path = at < row.cells.size() ? normal_path(row.cells[at]) : "";
    auto const entry = std::lower_bound(archive.entries.begin(), archive.entries.end(), path,
                                        [](ArchiveEntry const& e, std::string const& p) { return e.path < p; });
    if (entry != archive.entries.end() && entry->path == path)
      describe(*entry, heading, row);
    else
      archive.notes.push_back(std::string(kCatalogue) + " line " + std::to_string(row.line) + ": no model at \"" +
                              path + "\"");
  }
}

}  // namespace

Archive read_archive(fs::path const& root, ArchiveOptions const& options,
                     std::function<bool(ArchiveEntry const&)> const& opening) {
  std::error_code error;
  if (!fs::is_directory(root, error))
    throw Error(ErrorKind::invalid_input, root.string() + " is no folder", "name the folder that holds the models");
  Archive archive;
  Walk(root, options, archive).run();
  std::sort(archive.entries.begin(), archive.entries.end(),
            [](ArchiveEntry const& a, ArchiveEntry const& b) { return a.path < b.path; });
  std::sort(archive.notes.begin(), archive.notes.end());
  if (fs::path const catalogue = root / kCatalogue; fs::is_regular_file(catalogue, error))
    read_catalogue(catalogue, archive);
  for (ArchiveEntry& entry : archive.entries)
    if (!opening || opening(entry)) entry.estimate = estimate(entry);
  return archive;
}

}  // namespace vitrine::io
