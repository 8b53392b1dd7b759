// SPDX-License-Identifier: Apache-2.0
#include "io/read_mtl.h"

#include "io/colour.h"
#include "io/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace vitrine::io {
namespace {

std::string lower_case(std::string_view word) {
  std::string lower(word);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::optional<double> as_number(std::string_view word) {
  if (!word.empty() && word[0] == '+') word.remove_prefix(1);
  double value = 0;
  auto const [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (status != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Cuts the first word off.
std::string_view take_word(std::string_view& text) {
  std::size_t const begin = std::min(text.find_first_not_of(" \t"), text.size());
  std::size_t const end = std::min(text.find_first_of(" \t", begin), text.size());
  std::string_view const word = text.substr(begin, end - begin);
  text.remove_prefix(std::min(text.find_first_not_of(" \t", end), text.size()));
  return word;
}

/// "-s 2 2 1 -clamp on wood grain.png": options first, each with its values, then a file name that may hold spaces.
/// An option takes up to three numbers or one word such as `on`, but never the last word, which is the file.
MtlTexture parse_texture(std::string_view text) {
  MtlTexture texture;
  while (text.starts_with('-')) {
    std::string const option = lower_case(take_word(text));
    std::vector<double> numbers;
    std::string word;
    while (numbers.size() < 3 && word.empty()) {
      std::string_view rest = text;
      std::string_view const next = take_word(rest);
      if (rest.empty()) break;
      if (auto const number = as_number(next))
        numbers.push_back(*number);
      else if (numbers.empty() && (next == "on" || next == "off" || next.size() == 1))
        word = next;
      else
        break;
      text = rest;
    }
    for (std::size_t k = 0; k < std::min<std::size_t>(2, numbers.size()); ++k) {
      if (option == "-s") texture.scale[k] = numbers[k];
      if (option == "-o") texture.offset[k] = numbers[k];
    }
    if (option == "-clamp") texture.clamp = word == "on";
  }
  texture.file = text;
  return texture;
}

/// Three channels, or one for all.
std::optional<std::array<double, 3>> parse_colour(std::string_view text) {
  auto const first = as_number(take_word(text));
  if (!first) return std::nullopt;
  std::array<double, 3> colour{*first, *first, *first};
  for (std::size_t k = 1; k < 3 && !text.empty(); ++k) colour[k] = as_number(take_word(text)).value_or(0);
  for (double& c : colour) c = std::clamp(c, 0.0, 1.0);
  return colour;
}

/// The last number: "d -halo 0.3" has an option in front.
double parse_opacity(std::string_view text) {
  std::string_view last;
  while (!text.empty()) last = take_word(text);
  return std::clamp(as_number(last).value_or(1), 0.0, 1.0);
}

void parse_statement(std::string const& key, std::string_view rest, MtlMaterial& material,
                     std::vector<std::string>& notes) {
  if (key == "kd")
    material.kd = parse_colour(rest);
  else if (key == "d")
    material.opacity = parse_opacity(rest);
  else if (key == "tr")
    material.opacity = 1 - std::clamp(as_number(rest).value_or(0), 0.0, 1.0);
  else if (key == "map_kd")
    material.colour_map = parse_texture(rest);
  else if (key == "norm")
    material.normal_map = parse_texture(rest);
  else if (key == "map_bump" || key == "bump" || key == "map_d" || key == "map_ke")
    notes.push_back(key + " of material \"" + material.name + "\" is not drawn");
}

Rgba linear(std::array<double, 3> const& srgb, double opacity) {
  auto const channel = [](double c) { return static_cast<float>(linear16(c)) / 65535; };
  return {channel(srgb[0]), channel(srgb[1]), channel(srgb[2]), static_cast<float>(opacity)};
}

TextureUse use(MtlTexture const& texture, ColourSpace space, Textures& textures, Resolve const& resolve) {
  TextureUse result;
  if (texture.file.empty()) return result;
  result.image = textures.take(texture.file, space, [&] { return resolve(texture.file); });
  result.wrap_u = result.wrap_v = texture.clamp ? Wrap::clamp : Wrap::repeat;
  // Scale and offset act on OBJ's upward v; ours runs down.
  auto const [su, sv] = texture.scale;
  auto const [ou, ov] = texture.offset;
  result.matrix = {static_cast<float>(su),         0, static_cast<float>(ou), 0, static_cast<float>(sv),
                   static_cast<float>(1 - sv - ov)};
  return result;
}

}  // namespace

std::vector<MtlMaterial> parse_mtl(std::string_view text, std::vector<std::string>& notes) {
  std::vector<MtlMaterial> materials;
  TextScanner scanner(text, "MTL");
  while (scanner.next_line()) {
    std::string const key = lower_case(scanner.word());
    std::string_view const rest = scanner.rest_of_line();
    if (key == "newmtl")
      materials.emplace_back().name = rest;
    else if (!materials.empty())
      parse_statement(key, rest, materials.back(), notes);
  }
  return materials;
}

Material to_material(MtlMaterial const& source, bool vertex_colours, MtlKd mtl_kd, Textures& textures,
                     Resolve const& resolve, std::vector<std::string>& notes) {
  constexpr std::array<double, 3> white{1, 1, 1}, black{0, 0, 0}, grey{0.8, 0.8, 0.8};
  Material material;
  material.name = source.name;
  material.colour_map = use(source.colour_map, ColourSpace::srgb, textures, resolve);
  material.normal_map = use(source.normal_map, ColourSpace::linear, textures, resolve);
  material.alpha = source.opacity < 1 ? AlphaMode::blend : AlphaMode::opaque;
  bool const mapped = material.colour_map.image >= 0;
  material.coloured = mapped || source.kd;

  std::array<double, 3> kd = source.kd.value_or(mapped || vertex_colours ? white : grey);
  if (mapped && kd != white && (kd == black || mtl_kd == MtlKd::ignore)) {
    notes.push_back("Kd of material \"" + source.name + "\" ignored, since it has a map_Kd");
    kd = white;
  }
  material.base_colour = linear(kd, source.opacity);
  return material;
}

}  // namespace vitrine::io
