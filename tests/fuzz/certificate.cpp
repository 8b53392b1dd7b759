// SPDX-License-Identifier: Apache-2.0
// certificate.json of a gallery that somebody else made: read and reported on, or nothing.
#include "graph/certificate.h"
#include "graph/bounded_json.h"
#include "tests/fuzz/reader.h"

namespace {

void read(std::string const& text) {
  using namespace vitrine;
  std::optional<graph::Record> const record = graph::record_from_certificate(text, "slug-00000000");
  if (!record) return;
  fuzz::require(record->row.status == "done");
  fuzz::require(!graph::to_text(graph::report_json({record->row}, "archive", {}, 0)).empty());
  fuzz::require(graph::record_from(graph::to_bytes(*record)).has_value());
}

}  // namespace

/// As it is, and under the seal that it should have.
extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string const text(reinterpret_cast<char const*>(data), size);
  read(text);
  std::optional<vitrine::graph::StrictOrderedJson> certificate = vitrine::graph::bounded_json(text);
  if (!certificate || !certificate->is_object()) return 0;
  (*certificate)["seal"] = vitrine::graph::seal_of(*certificate);
  read(vitrine::graph::to_text(*certificate));
  return 0;
}
