// SPDX-License-Identifier: Apache-2.0
#include "graph/bounded_json.h"

#include <cstddef>

namespace vitrine::graph {
namespace {

using json = StrictJson;

constexpr int kDeepest = 64;

/// Reads without keeping anything, and stops where it becomes too deep.
class Depth final : public json::json_sax_t {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(json::number_integer_t) override { return true; }
  bool number_unsigned(json::number_unsigned_t) override { return true; }
  bool number_float(json::number_float_t, std::string const&) override { return true; }
  bool string(std::string&) override { return true; }
  bool binary(json::binary_t&) override { return true; }
  bool key(std::string&) override { return true; }
  bool start_object(std::size_t) override { return ++depth_ <= kDeepest; }
  bool end_object() override { return --depth_, true; }
  bool start_array(std::size_t) override { return ++depth_ <= kDeepest; }
  bool end_array() override { return --depth_, true; }
  bool parse_error(std::size_t, std::string const&, json::exception const&) override { return false; }

 private:
  int depth_ = 0;
};

}  // namespace

std::optional<json> bounded_cbor(std::string_view bytes) try {
  Depth depth;
  if (!json::sax_parse(bytes.begin(), bytes.end(), &depth, json::input_format_t::cbor)) return {};
  return json::from_cbor(bytes.begin(), bytes.end());
} catch (json::exception const&) {
  return {};
}

std::optional<StrictOrderedJson> bounded_json(std::string_view text) try {
  Depth depth;
  if (!json::sax_parse(text.begin(), text.end(), &depth)) return {};
  return StrictOrderedJson::parse(text.begin(), text.end());
} catch (json::exception const&) {
  return {};
}

}  // namespace vitrine::graph
