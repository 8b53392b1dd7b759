// SPDX-License-Identifier: Apache-2.0
#include "io/zip.h"

#include "stages/error.h"

#include <zip.h>

#include <memory>
#include <string>

namespace vitrine::io {
namespace {

/// The least date that ZIP can tell, in its own form: day 1, month 1 of year 0 since 1980.
constexpr zip_uint16_t kMidnight = 0, kFirstDay = 1 << 5 | 1;

[[noreturn]] void fail(std::string const& what) {
  throw Error(ErrorKind::broken, "libzip: " + what, "report this as a bug");
}

void require(bool done, zip_t* archive) {
  if (!done) fail(zip_strerror(archive));
}

void add(zip_t* archive, NamedFile const& file) {
  zip_source_t* const source = zip_source_buffer(archive, file.bytes.data(), file.bytes.size(), 0);
  require(source != nullptr, archive);
  zip_int64_t const index = zip_file_add(archive, file.name.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (index < 0) zip_source_free(source);
  require(index >= 0, archive);
  zip_uint64_t const entry = static_cast<zip_uint64_t>(index);
  require(zip_set_file_compression(archive, entry, ZIP_CM_DEFLATE, 9) == 0, archive);
  require(zip_file_set_dostime(archive, entry, kMidnight, kFirstDay, 0) == 0, archive);
}

std::vector<std::byte> content(zip_source_t* source) {
  zip_stat_t stat;
  if (zip_source_stat(source, &stat) != 0 || zip_source_open(source) != 0) fail("cannot read what it wrote");
  std::vector<std::byte> bytes(stat.size);
  zip_int64_t const read = zip_source_read(source, bytes.data(), bytes.size());
  zip_source_close(source);
  if (read != static_cast<zip_int64_t>(bytes.size())) fail("cannot read what it wrote");
  return bytes;
}

}  // namespace

std::vector<std::byte> zip(std::span<NamedFile const> files) {
  zip_error_t error;
  zip_error_init(&error);
  std::unique_ptr<zip_source_t, decltype(&zip_source_free)> const target(
      zip_source_buffer_create(nullptr, 0, 0, &error), zip_source_free);
  if (!target) fail(zip_error_strerror(&error));
  zip_source_keep(target.get());  // the archive takes one reference
  std::unique_ptr<zip_t, decltype(&zip_discard)> archive(
      zip_open_from_source(target.get(), ZIP_CREATE | ZIP_TRUNCATE, &error), zip_discard);
  if (!archive) {
    zip_source_free(target.get());
    fail(zip_error_strerror(&error));
  }
  for (NamedFile const& file : files) add(archive.get(), file);
  require(zip_close(archive.get()) == 0, archive.get());
  static_cast<void>(archive.release());
  return content(target.get());
}

}  // namespace vitrine::io
