// SPDX-License-Identifier: Apache-2.0
#include "io/dependencies.h"

#include <sys/stat.h>
#include <xxhash.h>

#include <array>
#include <fstream>
#include <memory>
#include <utility>
#include <vector>

namespace vitrine::io {
namespace {

std::int64_t nanoseconds(timespec const& time) { return std::int64_t(time.tv_sec) * 1'000'000'000 + time.tv_nsec; }

std::string digits(XXH128_hash_t const& hash) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, hash);
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (unsigned char byte : canonical.digest) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

}  // namespace

std::string content_hash(std::span<std::byte const> bytes) { return digits(XXH3_128bits(bytes.data(), bytes.size())); }

std::string content_hash(std::string_view text) { return content_hash(std::as_bytes(std::span(text))); }

std::string file_hash(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return {};
  std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> const state(XXH3_createState(), XXH3_freeState);
  XXH3_128bits_reset(state.get());
  std::vector<char> piece(1 << 20);
  while (file.read(piece.data(), std::streamsize(piece.size())), file.gcount() > 0)
    XXH3_128bits_update(state.get(), piece.data(), std::size_t(file.gcount()));
  return file.bad() ? std::string() : digits(XXH3_128bits_digest(state.get()));
}

Resolve recording(Resolve resolve, Dependencies& found) {
  return [resolve = std::move(resolve), &found](std::string_view reference) {
    std::string& hash = found[std::string(reference)] = {};
    std::optional<Blob> file = resolve(reference);
    if (file) hash = content_hash(file->bytes);
    return file;
  };
}

std::optional<Stamp> stamp(std::filesystem::path const& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return std::nullopt;
  return Stamp{std::uint64_t(status.st_size), status.st_ino, nanoseconds(status.st_mtim), nanoseconds(status.st_ctim)};
}

bool settled(Stamp const& stamp, std::chrono::system_clock::time_point moment) {
  auto const limit =
      std::chrono::duration_cast<std::chrono::nanoseconds>(moment.time_since_epoch()) - std::chrono::seconds(2);
  return stamp.changed < limit.count() && stamp.modified < limit.count();
}

}  // namespace vitrine::io
