// SPDX-License-Identifier: Apache-2.0
#include "io/ply_header.h"

#include "io/text_scanner.h"

#include <algorithm>
#include <array>
#include <utility>

namespace vitrine::io {
namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr std::array<TypeName, 16> kTypes{{{"char", PlyType::int8},
                                           {"int8", PlyType::int8},
                                           {"uchar", PlyType::uint8},
                                           {"uint8", PlyType::uint8},
                                           {"short", PlyType::int16},
                                           {"int16", PlyType::int16},
                                           {"ushort", PlyType::uint16},
                                           {"uint16", PlyType::uint16},
                                           {"int", PlyType::int32},
                                           {"int32", PlyType::int32},
                                           {"uint", PlyType::uint32},
                                           {"uint32", PlyType::uint32},
                                           {"float", PlyType::float32},
                                           {"float32", PlyType::float32},
                                           {"double", PlyType::float64},
                                           {"float64", PlyType::float64}}};

PlyType parse_type(TextScanner const& lines, std::string_view word) {
  auto const found = std::find_if(kTypes.begin(), kTypes.end(), [&](TypeName const& t) { return t.name == word; });
  if (found == kTypes.end()) throw lines.error(shown(word) + " is no PLY type");
  return found->type;
}

PlyFormat parse_format(TextScanner& lines) {
  std::string_view const word = lines.word();
  if (word == "ascii") return PlyFormat::ascii;
  if (word == "binary_little_endian") return PlyFormat::little_endian;
  if (word == "binary_big_endian") return PlyFormat::big_endian;
  throw lines.error(shown(word) + " is no PLY format");
}

PlyElement parse_element(TextScanner& lines, std::vector<PlyElement> const& before) {
  constexpr std::size_t kMost = 1000;
  if (before.size() == kMost) throw lines.error("more than " + std::to_string(kMost) + " elements");
  PlyElement element;
  element.name = lines.word();
  for (PlyElement const& other : before)
    if (other.name == element.name) throw lines.error("element " + shown(element.name) + " is announced twice");
  std::int64_t const count = lines.integer();
  if (count < 0) throw lines.error(std::to_string(count) + " elements announced");
  element.count = std::uint64_t(count);
  return element;
}

PlyProperty parse_property(TextScanner& lines) {
  PlyProperty property;
  std::string_view word = lines.word();
  if (word == "list") {
    property.count_type = parse_type(lines, lines.word());
    if (*property.count_type == PlyType::float32 || *property.count_type == PlyType::float64)
      throw lines.error("a list's length cannot be a fraction");
    word = lines.word();
  }
  property.type = parse_type(lines, word);
  property.name = lines.word();
  if (property.name.empty()) throw lines.error("a property has no name");
  return property;
}

std::optional<std::size_t> find(PlyElement const& element, std::initializer_list<std::string_view> names, bool list) {
  for (std::string_view name : names)
    for (std::size_t i = 0; i < element.properties.size(); ++i)
      if (element.properties[i].name == name && element.properties[i].count_type.has_value() == list) return i;
  return std::nullopt;
}

}  // namespace

std::size_t size_of(PlyType type) {
  static constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

std::optional<std::size_t> PlyElement::scalar(std::initializer_list<std::string_view> names) const {
  return find(*this, names, false);
}

std::optional<std::size_t> PlyElement::list(std::initializer_list<std::string_view> names) const {
  return find(*this, names, true);
}

PlyHeader parse_ply_header(std::string_view file) {
  TextScanner lines(file, "PLY");
  if (!lines.next_line() || lines.rest_of_line() != "ply")
    throw Error(ErrorKind::invalid_input, "no PLY file: it does not begin with \"ply\"", damage_remedy(file));
  PlyHeader header;
  std::optional<PlyFormat> format;
  for (;;) {
    if (!lines.next_line()) throw lines.error("the header has no end", damage_remedy(file));
    std::string_view const keyword = lines.word();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      format = parse_format(lines);
    } else if (keyword == "element") {
      header.elements.push_back(parse_element(lines, header.elements));
    } else if (keyword == "property") {
      if (header.elements.empty()) throw lines.error("a property stands before any element");
      header.elements.back().properties.push_back(parse_property(lines));
    } else if (keyword == "comment") {
      if (lines.word() != "TextureFile") continue;
      if (std::string_view const name = lines.rest_of_line(); !name.empty()) header.textures.emplace_back(name);
    } else if (keyword != "obj_info") {
      throw lines.error(shown(keyword) + " is no PLY keyword", damage_remedy(file));
    }
  }
  if (!format) throw lines.error("the header names no format");
  header.format = *format;
  header.bytes = file.size() - lines.bytes_left();
  header.lines = lines.line();
  return header;
}

}  // namespace vitrine::io
