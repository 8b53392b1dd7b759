// SPDX-License-Identifier: Apache-2.0
#include "io/blob.h"

#include "io/fault.h"
#include "io/text_scanner.h"
#include "stages/error.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <system_error>
#include <utility>

namespace vitrine::io {
namespace {

namespace fs = std::filesystem;

Error unreadable(fs::path const& path, std::string const& why) {
  return Error(ErrorKind::invalid_input, path.filename().string() + " cannot be read: " + why,
               "check that it is a regular file that you may read");
}

/// What the system says lies in the file, or in the disk that holds it.
[[noreturn]] void refuse(fs::path const& path, int reason) {
  std::error_code const code(reason, std::generic_category());
  if (reason == EIO || reason == ESTALE) throw fs::filesystem_error("cannot read", path, code);
  throw unreadable(path, code.message());
}

Error leads_out(std::string_view reference, std::string const& how) {
  return Error(ErrorKind::invalid_input, "the model names " + shown(reference) + ", which " + how,
               "put the file beside the model and name it relative to the model's folder");
}

/// A file descriptor that is closed on every way out.
struct File {
  int descriptor;
  explicit File(fs::path const& path) : descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  File(File const&) = delete;
  File& operator=(File const&) = delete;
  ~File() {
    if (descriptor >= 0) ::close(descriptor);
  }
};

/// "https:", "data:", "C:": whatever stands before a colon in the first part of the path.
bool has_scheme(std::string_view reference) {
  std::size_t const colon = reference.find(':');
  if (colon == 0 || colon == std::string_view::npos) return false;
  return std::all_of(reference.begin(), reference.begin() + std::ptrdiff_t(colon), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+' || c == '-' ||
           c == '.';
  });
}

std::string percent_decoded(std::string_view escaped) {
  std::string decoded;
  for (std::size_t i = 0; i < escaped.size(); ++i) {
    unsigned value = 0;
    char const* const digits = escaped.data() + i + 1;
    if (escaped[i] == '%' && i + 2 < escaped.size() &&
        std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
      decoded += static_cast<char>(value);
      i += 2;
    } else {
      decoded += escaped[i];
    }
  }
  return decoded;
}

std::string lower_case(std::string name) {
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return name;
}

/// The reference as a path below the model's folder. Errors: InvalidInput when it leads elsewhere.
fs::path relative_path(std::string name, std::string_view reference) {
  std::replace(name.begin(), name.end(), '\\', '/');
  if (name.find('\0') != std::string::npos) throw leads_out(reference, "holds a zero byte");
  if (has_scheme(name)) throw leads_out(reference, "is an address, not a file of the archive");
  fs::path const path = fs::path(name).lexically_normal();
  if (path.is_absolute()) throw leads_out(reference, "is an absolute path");
  if (path.begin() != path.end() && *path.begin() == "..")
    throw leads_out(reference, "leads out of the model's folder");
  return path;
}

/// `path` below `folder` with each part in whatever case the file system has it; nothing when none or several fit.
std::optional<fs::path> in_any_case(fs::path const& folder, fs::path const& path) {
  fs::path found = folder;
  std::error_code error;
  for (fs::path const& part : path) {
    fs::path exact = found / part;
    if (!fs::exists(exact, error)) {
      std::string const wanted = lower_case(part.string());
      std::vector<fs::path> matches;
      for (fs::directory_iterator it(found, error), end; !error && it != end; it.increment(error))
        if (lower_case(it->path().filename().string()) == wanted) matches.push_back(it->path());
      if (matches.size() != 1) return std::nullopt;
      exact = matches.front();
    }
    found = exact;
  }
  return found;
}

/// The file itself, unless symbolic links lead out of `folder`.
fs::path inside(fs::path const& folder, fs::path const& file, std::string_view reference) {
  fs::path const real = fs::canonical(file), home = fs::canonical(folder);
  if (std::mismatch(home.begin(), home.end(), real.begin(), real.end()).first != home.end())
    throw leads_out(reference, "is a symbolic link that leads out of the model's folder");
  return real;
}

}  // namespace

Blob own(std::vector<std::byte> bytes) {
  auto owner = std::make_shared<std::vector<std::byte> const>(std::move(bytes));
  return {*owner, owner};
}

std::string_view characters(std::span<std::byte const> bytes) {
  return {reinterpret_cast<char const*>(bytes.data()), bytes.size()};
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

std::string_view text(Blob const& blob) { return without_mark(characters(blob.bytes)); }

Blob map_file(fs::path const& path) {
  if (int const error = injected_error("open")) refuse(path, error);
  File const file(path);
  if (file.descriptor < 0) refuse(path, errno);
  struct stat status {};
  if (::fstat(file.descriptor, &status) != 0) refuse(path, errno);
  if (!S_ISREG(status.st_mode)) throw unreadable(path, "it is no regular file");
  auto const size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return {};
  void* const start = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.descriptor, 0);
  if (start == MAP_FAILED) refuse(path, errno);
  ::madvise(start, size, MADV_SEQUENTIAL);
  std::shared_ptr<void const> owner(start, [size](void const* p) { ::munmap(const_cast<void*>(p), size); });
  return {{static_cast<std::byte const*>(start), size}, std::move(owner)};
}

std::optional<fs::path> find_in(fs::path const& where, std::string_view reference) {
  fs::path const folder = where.empty() ? fs::path(".") : where;
  fs::path const literal = relative_path(std::string(reference), reference);
  fs::path const decoded = relative_path(percent_decoded(reference), reference);
  std::error_code error;
  for (fs::path const& path : {literal, decoded})
    if (fs::is_regular_file(folder / path, error)) return inside(folder, folder / path, reference);
  for (fs::path const& path : {literal, decoded})
    if (std::optional<fs::path> const found = in_any_case(folder, path); found && fs::is_regular_file(*found, error))
      return inside(folder, *found, reference);
  return std::nullopt;
}

Resolve resolve_in(fs::path const& folder) {
  return [folder](std::string_view reference) -> std::optional<Blob> {
    std::optional<fs::path> const found = find_in(folder, reference);
    return found ? std::optional(map_file(*found)) : std::nullopt;
  };
}

}  // namespace vitrine::io
