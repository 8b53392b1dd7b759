// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Typed access to the JSON of a glTF document: what is absent takes its default, what has the wrong type is an Error.
/// Internal to io.
///
/// tinygltf 2.7 was tried and left out: it refuses Draco indices without a buffer view and meshopt's fallback buffers,
/// both of which real exporters write; it copies every buffer; and it recurses as deep as the file says.

#include "stages/error.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace vitrine::io {

using GltfJson = nlohmann::json;

[[noreturn]] inline void refuse_gltf(std::string const& what) {
  throw Error(ErrorKind::invalid_input, "glTF: " + what,
              "check the file with the Khronos glTF validator and export it again");
}

/// The member; null when there is none.
inline GltfJson const* member(GltfJson const& object, char const* key) {
  if (!object.is_object()) return nullptr;
  auto const found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

/// The member at the end of a path of keys; null when a step is missing.
template <class... Keys>
GltfJson const* member(GltfJson const& object, char const* key, Keys... keys) {
  GltfJson const* const inner = member(object, key);
  return inner ? member(*inner, keys...) : nullptr;
}

inline GltfJson const* extension(GltfJson const& object, char const* name) {
  return member(object, "extensions", name);
}

/// A whole number from 0; some writers store it as 1.0.
inline std::optional<std::uint64_t> whole(GltfJson const& object, char const* key) {
  GltfJson const* const value = member(object, key);
  if (!value) return std::nullopt;
  if (value->is_number_unsigned()) return value->get<std::uint64_t>();
  double const number = value->is_number_float() ? value->get<double>() : -1;
  if (!(number >= 0 && number < 0x1p53 && number == std::floor(number)))
    refuse_gltf(std::string(key) + " is no whole number from 0");
  return static_cast<std::uint64_t>(number);
}

inline std::uint64_t required(GltfJson const& object, char const* key) {
  std::optional<std::uint64_t> const value = whole(object, key);
  if (!value) refuse_gltf(std::string(key) + " is missing");
  return *value;
}

inline double real(GltfJson const& object, char const* key, double otherwise) {
  GltfJson const* const value = member(object, key);
  if (!value) return otherwise;
  if (!value->is_number()) refuse_gltf(std::string(key) + " is no number");
  return value->get<double>();
}

inline bool flag(GltfJson const& object, char const* key) {
  GltfJson const* const value = member(object, key);
  return value && value->is_boolean() && value->get<bool>();
}

inline std::string string(GltfJson const& object, char const* key) {
  GltfJson const* const value = member(object, key);
  return value && value->is_string() ? value->get<std::string>() : std::string();
}

template <std::size_t N>
std::array<double, N> reals(GltfJson const& object, char const* key, std::array<double, N> const& otherwise) {
  GltfJson const* const value = member(object, key);
  if (!value) return otherwise;
  if (!value->is_array() || value->size() != N)
    refuse_gltf(std::string(key) + " is no list of " + std::to_string(N) + " numbers");
  std::array<double, N> result{};
  for (std::size_t i = 0; i < N; ++i) {
    if (!(*value)[i].is_number()) refuse_gltf(std::string(key) + " is no list of numbers");
    result[i] = (*value)[i].template get<double>();
  }
  return result;
}

/// A list member; an empty one when there is none.
inline GltfJson const& list(GltfJson const& object, char const* key) {
  static GltfJson const empty = GltfJson::array();
  GltfJson const* const value = member(object, key);
  if (!value) return empty;
  if (!value->is_array()) refuse_gltf(std::string(key) + " is no list");
  return *value;
}

}  // namespace vitrine::io
