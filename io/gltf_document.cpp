// SPDX-License-Identifier: Apache-2.0
#include "io/gltf_document.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace vitrine::io {
namespace {

std::size_t round_up(std::size_t value, std::size_t multiple) { return (value + multiple - 1) / multiple * multiple; }

void put_u32(std::vector<std::byte>& to, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) to.push_back(static_cast<std::byte>(value >> shift & 0xFF));
}

/// One GLB chunk: length, type, content, padding.
void put_chunk(std::vector<std::byte>& to, std::string_view type, std::span<std::byte const> content, char padding) {
  std::size_t const padded = round_up(content.size(), 4);
  put_u32(to, padded);
  std::ranges::copy(std::as_bytes(std::span(type)), std::back_inserter(to));
  to.insert(to.end(), content.begin(), content.end());
  to.insert(to.end(), padded - content.size(), static_cast<std::byte>(padding));
}

}  // namespace

std::size_t GltfDocument::append(std::span<std::byte const> bytes, std::size_t alignment) {
  std::size_t const offset = round_up(bin_.size(), alignment);
  bin_.resize(offset);
  bin_.insert(bin_.end(), bytes.begin(), bytes.end());
  return offset;
}

std::size_t GltfDocument::add_view(std::span<std::byte const> bytes, Json more, std::size_t alignment) {
  std::size_t const offset = append(bytes, alignment);
  Json view = {{"buffer", 0}};
  if (offset > 0) view["byteOffset"] = offset;
  view["byteLength"] = bytes.size();
  view.update(more);
  return add(json, "bufferViews", std::move(view));
}

void GltfDocument::use_extension(std::string_view name, Need need) {
  auto include = [&](char const* list) {
    if (!json.contains(list) || std::ranges::find(json[list], name) == json[list].end()) add(json, list, name);
  };
  include("extensionsUsed");
  if (need == Need::required) include("extensionsRequired");
}

std::vector<std::byte> GltfDocument::glb() {
  json["buffers"][0]["byteLength"] = bin_.size();
  std::string const text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::vector<std::byte> file;
  std::ranges::copy(std::as_bytes(std::span(std::string_view("glTF"))), std::back_inserter(file));
  put_u32(file, 2);
  put_u32(file, 12 + 8 + round_up(text.size(), 4) + 8 + round_up(bin_.size(), 4));
  put_chunk(file, "JSON", std::as_bytes(std::span(text)), ' ');
  put_chunk(file, {"BIN\0", 4}, bin_, '\0');
  return file;
}

std::size_t add(Json& json, char const* list, Json element) {
  json[list].push_back(std::move(element));
  return json[list].size() - 1;
}

Json number(double value) {
  if (value == std::floor(value) && std::abs(value) < 1e9) return static_cast<std::int64_t>(value);
  return value;
}

Json number(float value) {
  std::array<char, 32> text;
  char const* const end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double shortest = 0;
  std::from_chars(text.data(), end, shortest);
  return number(shortest);
}

}  // namespace vitrine::io
