// SPDX-License-Identifier: Apache-2.0
/// tinyobjloader 2.0rc10 was tried and left out: it takes line ends as the last word, so that continued faces get index
/// 0 and fail; it splits the file names of mtllib at spaces; it reads inf and nan as 0; indices out of range are a
/// warning; and its callback interface, which alone keeps memory low, knows no vertex colours and no line numbers.
#include "io/obj_parser.h"

#include "io/assemble.h"
#include "io/colour.h"
#include "io/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace vitrine::io {
namespace {

/// "\" at the end of a line continues it: joined here, with the line ends put after it so that line numbers stay right.
std::string join_continued(std::string_view text) {
  std::string joined;
  joined.reserve(text.size());
  std::string line_ends;
  char const line_end = io::line_end(text);
  while (!text.empty()) {
    std::size_t const end = std::min(text.find(line_end), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    line_ends += '\n';
    if (line.ends_with('\\')) {
      joined.append(line.substr(0, line.size() - 1)) += ' ';
    } else {
      joined.append(line).append(line_ends);
      line_ends.clear();
    }
  }
  return joined;
}

bool has_continued(std::string_view text) {
  return text.find("\\\n") != std::string_view::npos || text.find("\\\r") != std::string_view::npos;
}

float finite_or_zero(double value) {
  auto const f = static_cast<float>(value);
  return std::isfinite(f) ? f : 0.0f;
}

/// Everything an OBJ says, statement by statement.
class ObjParser {
 public:
  ObjParser(std::string_view text, ReadLimits const& limits) : scanner_(text, "OBJ"), limits_(limits) {}

  ObjFile parse() {
    while (scanner_.next_line()) {
      statement(scanner_.word());
      if (scanner_.line() % 4096 == 0) check_growth();
    }
    if (!obj_.colours.empty()) obj_.colours.resize(obj_.v.size(), kWhite);
    check_growth();
    return std::move(obj_);
  }

 private:
  void statement(std::string_view key) {
    if (key == "v")
      vertex(scanner_.words());
    else if (key == "vt")
      texture_coordinate(scanner_.words());
    else if (key == "vn")
      obj_.vn.push_back(unit_or_zero(point(scanner_.words())));
    else if (key == "f")
      face();
    else if (key == "usemtl") {
      material_ = scanner_.rest_of_line();
      material_index_.reset();
    } else if (key == "mtllib")
      obj_.libraries.emplace_back(scanner_.rest_of_line());
  }

  using Words = std::span<std::string_view const>;

  double number(Words words, std::size_t i) const {
    return scanner_.number(i < words.size() ? words[i] : std::string_view());
  }
  V3d point(Words words) const { return {number(words, 0), number(words, 1), number(words, 2)}; }

  void vertex(Words words) {
    obj_.v.push_back(point(words));
    if (words.size() < 6) return;  // at most a weight
    auto const channel = [&](std::size_t i) {
      double const c = number(words, i);
      return c > 0 ? linear16(c) : std::uint16_t{0};  // nan too is black
    };
    obj_.colours.resize(obj_.v.size() - 1, kWhite);
    obj_.colours.push_back({channel(3), channel(4), channel(5), 65535});
  }

  void texture_coordinate(Words words) {
    double const upward = words.size() > 1 ? number(words, 1) : 0;
    obj_.vt.emplace_back(finite_or_zero(number(words, 0)), finite_or_zero(1 - upward));
  }

  void face() {
    face_.clear();
    for (std::string_view word = scanner_.word(); !word.empty() && word[0] != '#'; word = scanner_.word())
      face_.push_back(obj_.corners.number(corner(word)));
    if (face_.size() < 3) {
      ++obj_.short_faces;
      return;
    }
    if (!material_index_) material_index_ = material_number();
    for (std::size_t k = 2; k < face_.size(); ++k) {
      obj_.triangles.push_back({face_[0], face_[k - 1], face_[k]});
      obj_.face_materials.push_back(*material_index_);
    }
  }

  /// "v", "v/vt", "v//vn" or "v/vt/vn"; numbers from 1, or negative ones back from the last.
  ObjCorner corner(std::string_view word) {
    std::array<std::int64_t, 3> index{0, 0, 0};
    for (std::int64_t& i : index) {
      std::size_t const slash = std::min(word.find('/'), word.size());
      if (slash > 0) i = whole_number(word.substr(0, slash));
      word.remove_prefix(std::min(slash + 1, word.size()));
    }
    ObjCorner result;
    result.v = row(index[0], obj_.v.size());
    if (result.v == ObjCorner::none)
      throw scanner_.error("a face names vertex " + std::to_string(index[0]) + " of " + std::to_string(obj_.v.size()));
    result.vt = row(index[1], obj_.vt.size());
    result.vn = row(index[2], obj_.vn.size());
    obj_.lost_uvs += index[1] != 0 && result.vt == ObjCorner::none;
    obj_.lost_normals += index[2] != 0 && result.vn == ObjCorner::none;
    return result;
  }

  std::int64_t whole_number(std::string_view digits) const {
    std::int64_t value = 0;
    auto const [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (status != std::errc{} || end != digits.data() + digits.size())
      throw scanner_.error("a face names " + shown(digits));
    return value;
  }

  static std::uint32_t row(std::int64_t index, std::size_t rows) {
    auto const count = static_cast<std::int64_t>(rows);
    std::int64_t const i = index < 0 ? count + index : index - 1;
    return i >= 0 && i < count ? static_cast<std::uint32_t>(i) : ObjCorner::none;
  }

  std::uint16_t material_number() {
    auto const [entry, added] = material_numbers_.try_emplace(material_, obj_.material_names.size());
    if (added) obj_.material_names.push_back(material_);
    if (entry->second > std::numeric_limits<std::uint16_t>::max())
      throw Error(ErrorKind::limit_exceeded, "more than 65536 materials", "merge materials before");
    return static_cast<std::uint16_t>(entry->second);
  }

  void check_growth() const {
    std::uint64_t const bytes = obj_.v.size() * sizeof(V3d) + obj_.colours.size() * sizeof(Rgba16) +
                                obj_.vt.size() * sizeof(V2f) + obj_.vn.size() * sizeof(V3f) +
                                obj_.corners.keys().size() * (sizeof(ObjCorner) + 64) +
                                obj_.triangles.size() * (sizeof(Triangle) + 2);
    check_limits(limits_, std::max(obj_.v.size(), obj_.corners.keys().size()), obj_.triangles.size(), bytes);
  }

  TextScanner scanner_;
  ReadLimits const& limits_;
  ObjFile obj_;
  std::vector<std::uint32_t> face_;
  std::string material_;
  std::optional<std::uint16_t> material_index_;
  std::unordered_map<std::string, std::size_t> material_numbers_;
};

}  // namespace

ObjFile parse_obj(std::string_view text, ReadLimits const& limits) {
  if (!has_continued(text)) return ObjParser(text, limits).parse();
  std::string const joined = join_continued(text);
  return ObjParser(joined, limits).parse();
}

}  // namespace vitrine::io
