// SPDX-License-Identifier: Apache-2.0
#include "io/publish.h"

#include "io/fault.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <utility>
#include <vector>

namespace vitrine::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kAside = ".vitrine-unfinished";

[[noreturn]] void fail(char const* what, fs::path const& path, int reason) {
  throw fs::filesystem_error(what, path, std::error_code(reason, std::generic_category()));
}

/// An open file, or a folder, that closes itself.
class Descriptor {
 public:
  Descriptor(fs::path const& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor const&) = delete;
  Descriptor& operator=(Descriptor const&) = delete;

  bool is_open() const { return fd_ >= 0; }
  int get() const { return fd_; }
  int close() { return fd_ < 0 ? 0 : ::close(std::exchange(fd_, -1)); }

 private:
  int fd_;
};

void write_whole(Descriptor& file, std::span<std::byte const> bytes, fs::path const& path) {
  if (int const error = injected_error("write")) fail("cannot write", path, error);
  while (!bytes.empty()) {
    ssize_t const written = ::write(file.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("cannot write", path, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  if (int const error = injected_error("fsync")) fail("cannot flush to disk", path, error);
  if (::fsync(file.get()) != 0) fail("cannot flush to disk", path, errno);
  if (file.close() != 0) fail("cannot write", path, errno);
}

/// Makes the names in a folder last. File systems that cannot flush folders say EINVAL: nothing better is to be had
/// there.
void flush_folder(fs::path const& folder) {
  Descriptor const opened(folder, O_RDONLY | O_DIRECTORY);
  if (!opened.is_open() || (::fsync(opened.get()) != 0 && errno != EINVAL)) fail("cannot flush to disk", folder, errno);
}

void make_folder(fs::path const& folder) {
  if (fs::is_directory(folder)) return;
  fs::path const parent = folder.has_parent_path() ? folder.parent_path() : ".";
  make_folder(parent);
  fs::create_directory(folder);
  flush_folder(parent);
}

/// A name beside `path` that no other thread or process uses; short, since `path` may be as long as names can be.
fs::path name_aside(fs::path const& path) {
  static std::atomic<unsigned> count{0};
  std::string const unique = "." + std::to_string(::getpid()) + "-" + std::to_string(count++);
  return path.parent_path() / (unique + std::string(kAside));
}

}  // namespace

void publish_file(fs::path const& path, std::span<std::byte const> bytes) {
  fs::path const folder = path.has_parent_path() ? path.parent_path() : ".";
  make_folder(folder);
  fs::path const aside = name_aside(path);
  try {
    Descriptor file(aside, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW);
    if (!file.is_open()) fail("cannot make", aside, errno);
    write_whole(file, bytes, path);
    if (int const error = injected_error("rename")) fail("cannot rename", path, error);
    fs::rename(aside, path);
    fault("renamed");
  } catch (...) {
    std::error_code ignored;
    fs::remove(aside, ignored);
    throw;
  }
  flush_folder(folder);
}

void publish_file(fs::path const& path, std::string_view text) { publish_file(path, std::as_bytes(std::span(text))); }

bool is_full(std::error_code const& error) { return error == std::errc::no_space_on_device || error.value() == EDQUOT; }

void withdraw_file(fs::path const& path) {
  if (fs::remove(path)) flush_folder(path.parent_path());
}

void sweep_unfinished(fs::path const& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  auto const options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator entry(folder, options, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().filename().native().ends_with(kAside)) found.push_back(entry->path());
  for (fs::path const& path : found) fs::remove(path, error);
}

}  // namespace vitrine::io
