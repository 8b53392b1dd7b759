// SPDX-License-Identifier: Apache-2.0
#include "io/assemble.h"
#include "io/bytes.h"
#include "io/first_use.h"
#include "io/read_model.h"
#include "io/text_scanner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace vitrine::io {
namespace {

constexpr std::size_t kHeader = 84, kRecord = 50;
constexpr std::uint64_t kBytesPerTriangle = 12 + 3 * (12 + 12 + 8);  ///< all corners apart: positions twice, table

/// A place by its bits.
using Place = std::array<std::uint32_t, 3>;

Place place_of(V3f const& p) {
  auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); };  // -0 + 0 is 0: the same place
  return {bits(p.x), bits(p.y), bits(p.z)};
}

V3f point_of(Place const& place) {
  return {std::bit_cast<float>(place[0]), std::bit_cast<float>(place[1]), std::bit_cast<float>(place[2])};
}

/// Triangles over vertices that are one where their places are.
class Welder {
 public:
  explicit Welder(std::size_t expected) : places_(expected / 2) { triangles_.reserve(expected); }

  std::size_t triangles() const { return triangles_.size(); }

  void add(std::span<V3f const> corners) {
    keys_.clear();
    for (V3f const& corner : corners) keys_.push_back(place_of(corner));
    numbers_.resize(keys_.size());
    places_.number(keys_, numbers_);
    for (std::size_t i = 0; i < numbers_.size(); i += 3)
      triangles_.push_back({numbers_[i], numbers_[i + 1], numbers_[i + 2]});
  }

  SourceModel model() && {
    SourceModel model;
    model.mesh.triangles = std::move(triangles_);
    model.mesh.positions.reserve(places_.keys().size());
    for (Place const& place : places_.keys()) model.mesh.positions.push_back(point_of(place));
    return model;
  }

 private:
  std::vector<Triangle> triangles_;
  FirstUse<Place> places_;
  std::vector<Place> keys_;
  std::vector<std::uint32_t> numbers_;
};

std::string lower_case(std::string_view word) {
  std::string result(word);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

void check_size(std::uint64_t triangles, ReadLimits const& limits) {
  check_limits(limits, 3 * triangles, triangles, triangles * kBytesPerTriangle);
}

bool is_ascii(std::string_view file) {
  std::string const head = lower_case(file.substr(0, 1024));
  std::size_t const first = head.find_first_not_of(" \t\r\n");
  return first != std::string::npos && head.compare(first, 5, "solid") == 0 &&
         (head.find("facet") != std::string::npos || head.find("endsolid") != std::string::npos);
}

V3f vertex(TextScanner& lines) {
  auto const x = static_cast<float>(lines.number()), y = static_cast<float>(lines.number());
  return {x, y, static_cast<float>(lines.number())};
}

SourceModel read_ascii(std::string_view text, ReadLimits const& limits) {
  TextScanner lines(text, "STL");
  Welder welder(0);
  std::vector<V3f> corners;
  bool open = false;
  while (lines.next_line()) {
    std::string const keyword = lower_case(lines.word());
    if (keyword == "solid") {
      open = true;
    } else if (keyword == "vertex") {
      corners.push_back(vertex(lines));
    } else if (keyword == "endloop") {
      if (corners.size() != 3)
        throw lines.error("a facet has " + std::to_string(corners.size()) + " corners instead of 3");
      check_size(welder.triangles() + 1, limits);
      welder.add(corners);
      corners.clear();
    } else if (keyword == "endsolid") {
      open = false;
    } else if (keyword != "facet" && keyword != "outer" && keyword != "endfacet") {
      throw lines.error(shown(keyword) + " is no STL keyword", damage_remedy(text));
    }
  }
  if (!corners.empty()) throw lines.error("the file ends within a facet", damage_remedy(text));
  SourceModel model = std::move(welder).model();
  if (open) model.notes.push_back("the STL file has no endsolid: perhaps it is cut off");
  return model;
}

SourceModel read_binary(std::span<std::byte const> bytes, std::string_view text, ReadOptions const& options) {
  if (bytes.size() < kHeader)
    throw Error(ErrorKind::invalid_input,
                "no STL file: " + std::to_string(bytes.size()) + " bytes, a binary one has " + std::to_string(kHeader) +
                    " or more",
                damage_remedy(text));
  std::uint64_t const promised = load<std::uint32_t>(bytes.data() + kHeader - 4);
  std::uint64_t const present = (bytes.size() - kHeader) / kRecord;
  if (promised != present)
    throw Error(
        ErrorKind::invalid_input,
        "the STL header says " + std::to_string(promised) + " triangles, the file holds " + std::to_string(present),
        damage_remedy(text));
  check_size(promised, options.limits);
  Welder welder(promised);
  constexpr std::size_t kBlock = 1024;
  std::vector<V3f> corners;
  for (std::size_t begin = 0; begin < promised; begin += kBlock) {
    corners.clear();
    for (std::size_t i = begin; i < std::min<std::size_t>(promised, begin + kBlock); ++i)
      for (std::size_t c = 1; c <= 3; ++c) {  // the facet's normal comes first
        std::byte const* const at = bytes.data() + kHeader + i * kRecord + 12 * c;
        corners.emplace_back(load<float>(at), load<float>(at + 4), load<float>(at + 8));
      }
    welder.add(corners);
  }
  SourceModel model = std::move(welder).model();
  if (std::size_t const rest = (bytes.size() - kHeader) % kRecord; rest > 0)
    model.notes.push_back(std::to_string(rest) + " bytes after the last triangle of the STL file ignored");
  return model;
}

/// Many binary files begin with "solid" too: what fits the binary size exactly is binary.
bool is_binary_size(std::span<std::byte const> bytes) {
  return bytes.size() >= kHeader &&
         bytes.size() == kHeader + kRecord * std::uint64_t(load<std::uint32_t>(bytes.data() + kHeader - 4));
}

}  // namespace

SourceModel read_stl(Blob const& file, Resolve const&, ReadOptions const& options) {
  std::string_view const characters = text(file);
  bool const ascii = !is_binary_size(file.bytes) && is_ascii(characters);
  SourceModel model = ascii ? read_ascii(characters, options.limits) : read_binary(file.bytes, characters, options);
  if (model.mesh.triangles.empty())
    throw Error(ErrorKind::invalid_input, "the STL file has no triangles", "export the model again, with its surface");
  return model;
}

}  // namespace vitrine::io
