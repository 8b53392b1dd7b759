// SPDX-License-Identifier: Apache-2.0
// archive.csv: an archive whose models are told of by any bytes is read, or the table is refused with its line.
#include "io/archive.h"
#include "tests/fuzz/reader.h"
#include "tests/support/folders.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace vitrine;
  static test::TemporaryFolder const folder;
  static bool const written = [] {
    for (char const* name : {"a.ply", "hall/b.obj"}) test::write_file(folder.path() / name, "");
    return true;
  }();
  fuzz::require(written);
  test::write_file(folder.path() / "archive.csv", std::string(reinterpret_cast<char const*>(data), size));
  try {
    io::Archive const archive = io::read_archive(folder.path());
    fuzz::require(archive.entries.size() == 2);
    for (io::ArchiveEntry const& entry : archive.entries)
      fuzz::require(!entry.metadata.contains("path") && !entry.metadata.contains("up"));
  } catch (Error const& error) {
    fuzz::require(error.kind() == ErrorKind::invalid_input);
    fuzz::require(std::string(error.what()).find("archive.csv") != std::string::npos);
  }
  return 0;
}
