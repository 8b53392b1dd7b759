// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The museum: each object's surface, how it is painted and in which format it is written. To add one, write its parts
/// and a row.

#include "tools/sample/scan.h"

#include <span>
#include <string_view>

namespace vitrine::sample {

enum class Format { ply_ascii, ply_little, ply_big, obj, stl, off, glb };
enum class Colour { none, vertices, jpeg, png };

struct Object {
  std::string_view name, folder, title;
  std::vector<Part> (*parts)(std::uint32_t seed);
  Format format;
  Colour colour;
  bool closed;  ///< no open edge
  bool z_up;
  std::uint64_t triangles;  ///< unless asked otherwise
};

std::span<Object const> objects();

std::vector<Part> amphora(std::uint32_t seed);   ///< black-figure vase with two handles
std::vector<Part> bowl(std::uint32_t seed);      ///< thin glazed ware, one open sheet
std::vector<Part> bust(std::uint32_t seed);      ///< marble head on shoulders, z up
std::vector<Part> coin(std::uint32_t seed);      ///< silver, an owl in relief
std::vector<Part> column(std::uint32_t seed);    ///< Doric capital on a broken shaft
std::vector<Part> fossil(std::uint32_t seed);    ///< ammonite, a spiral that touches itself
std::vector<Part> knot(std::uint32_t seed);      ///< jade serpent in a knot, genus 1
std::vector<Part> mask(std::uint32_t seed);      ///< gold sheet, open at its edge
std::vector<Part> mosaic(std::uint32_t seed);    ///< panel of a floor, open at its edge
std::vector<Part> necklace(std::uint32_t seed);  ///< many pieces on a string
std::vector<Part> ring(std::uint32_t seed);      ///< gold with a carved bezel, genus 1
std::vector<Part> sherd(std::uint32_t seed);     ///< piece of a vase with raw fractures, and scanning noise about it
std::vector<Part> sword(std::uint32_t seed);     ///< bronze, long and thin
std::vector<Part> tablet(std::uint32_t seed);    ///< clay with carved signs

}  // namespace vitrine::sample
