// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A glTF document while it is written: its JSON, and the binary chunk that buffer views cut up.

#include "stages/data.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace vitrine::io {

using Json = nlohmann::ordered_json;

enum class Need { optional, required };

class GltfDocument {
 public:
  Json json = {{"asset", {{"version", "2.0"}, {"generator", "vitrine"}}}};

  /// Puts bytes behind what the chunk holds, at a multiple of `alignment`; returns their offset.
  std::size_t append(std::span<std::byte const> bytes, std::size_t alignment = 1);
  /// The same, and a buffer view of them with `more` members; returns the view's index.
  std::size_t add_view(std::span<std::byte const> bytes, Json more = Json::object(), std::size_t alignment = 1);
  void use_extension(std::string_view name, Need need);

  /// The file: JSON without a space more than GLB asks for. Text that is no UTF-8 gets U+FFFD in the place of bad
  /// bytes.
  std::vector<std::byte> glb();

 private:
  std::vector<std::byte> bin_;
};

/// Appends to json[list], made when absent; returns the element's index.
std::size_t add(Json& json, char const* list, Json element);

/// The fewest digits that read back as this float; whole numbers without ".0".
Json number(float value);
Json number(double value);
template <class Vector>
Json numbers(Vector const& v) {
  Json list = Json::array();
  for (unsigned k = 0; k < Vector::dimensions(); ++k) list.push_back(number(v[k]));
  return list;
}

}  // namespace vitrine::io
