// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The search for the best thumbnail that a number of bytes can hold: what to try next, and which trial won.
///
/// One question at a time, each answered by one trial near the ceiling (more or fewer bits, colours per vertex or in a
/// texture, facets or normals), keeping what lowers the error at equal bytes; then the number of triangles that fills
/// the ceiling. Everything follows from the history of trials, so the search is deterministic and holds no state.

#include "stages/data.h"
#include "stages/options.h"
#include "stages/parameterize.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace vitrine {

/// What the search decides, by which name it can be left out.
enum class Choice {
  none,
  normals,       ///< facets always
  creases,       ///< one normal per vertex
  atlas,         ///< no texture over charts, where colours per vertex can do
  own_texture,   ///< the original's texture is never kept
  avif,          ///< maps as WebP or JPEG
  unfolding,     ///< charts stay as conformal maps lay them
  colour_edges,  ///< triangles go where the surface bends, whatever its colours
  bits,          ///< of positions and normals
  colours,       ///< bits and smoothness of colours per vertex
  palette,       ///< colours per vertex as red, green and blue
  swatches,      ///< flat colours are kept like any others
  refit,         ///< vertices stay where simplification left them
  structure      ///< the mean square error alone decides
};
template <>
struct EnumNames<Choice> {
  static constexpr std::array<std::string_view, 14> names{
      "none",         "normals", "creases", "atlas",   "own-texture", "avif",  "unfolding",
      "colour-edges", "bits",    "colours", "palette", "swatches",    "refit", "structure"};
};

struct FitOptions {
  double max_kb = 16;
  double max_error = 0;
  double max_px = 0;
  double max_deviation = 0;
  double pixel_ratio = 2;
  Choice without = Choice::none;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.max_kb, Field{"max-kb", "KB of 1000 bytes",
                             "no file is larger; the search spends them where they show most", 1, 1e5});
    visit(self.max_error,
          Field{"max-error", "MSE x 10^4",
                "0: fill --max-kb; else the smallest file whose measured error is at most this", 0, 1e4});
    visit(self.max_px, Field{"max-px", "pixels",
                             "0: any; else the smallest file whose surface lies nowhere farther from the original's, "
                             "as --viewport shows it",
                             0, 1000});
    visit(self.max_deviation,
          Field{"max-deviation", "box diagonals",
                "0: any; else the smallest file whose surface lies nowhere farther from the original's", 0, 1});
    visit(self.pixel_ratio,
          Field{"pixel-ratio", "", "device pixels per CSS pixel of the screens for which the search decides", 0.5, 4});
    visit(self.without, Field{"without", "", "for comparisons: what the search is to leave as it is"});
  }
};

enum class Shading {
  facets,  ///< no normals: clients draw each face flat
  smooth,  ///< a normal per vertex
  creased  ///< one for each side of the original's creases, see crease.h
};
template <>
struct EnumNames<Shading> {
  static constexpr std::array<std::string_view, 3> names{"facets", "smooth", "creased"};
};

enum class Painting {
  none,      ///< one colour, or none
  vertices,  ///< a colour per vertex
  swatches,  ///< a colour per face, of a few, see swatches.h
  map,       ///< a texture over an atlas of charts
  own        ///< the original's own texture, see own_texture.h
};
template <>
struct EnumNames<Painting> {
  static constexpr std::array<std::string_view, 5> names{"none", "vertices", "swatches", "map", "own"};
};

/// All that a trial decides.
struct Recipe {
  int triangles = 0;
  Shading shading = Shading::facets;
  Painting painting = Painting::none;
  double colour_weight = 0;  ///< of colour in the quadrics, see progression.h
  bool fitted = true;        ///< vertices are moved to where the surface fits best, see refit.h
  int position_bits = 10;
  int normal_bits = 6;                         ///< of each octahedral coordinate of a normal per vertex
  int colour_bits = 5;                         ///< of each of a colour's two numbers per vertex, see palette.h
  double smoothing = 0.1;                      ///< of colours per vertex, see paint.h
  Unfolding unfolding = Unfolding::conformal;  ///< of the charts
  int texture = 256;                           ///< texels of the longer side
  int map_quality = 0;                         ///< of 100; 0: the highest that `ceiling` allows
  int ceiling = 0;                             ///< of a file with a map, in bytes
  bool avif = false;                           ///< the map's coding, else WebP or JPEG
  bool full_chroma = false;                    ///< of a map in AVIF
  bool polished = false;                       ///< the last trials: the coding takes its time
  bool operator==(Recipe const&) const = default;
};

bool is_textured(Recipe const& recipe);
inline bool has_normals(Recipe const& recipe) { return recipe.shading != Shading::facets; }
/// Such files have the bytes that they may have, and can be compared as they are.
bool is_filled(Recipe const& recipe);

/// What the search knows of an original.
struct Subject {
  std::size_t triangles = 0;        ///< of the original: no recipe has more
  bool coloured = false;            ///< colour varies over the surface
  bool flat = false;                ///< in a few colours, see swatches.h
  bool creased = false;             ///< see crease.h
  std::size_t fixed_triangles = 0;  ///< by --max-deviation or --max-px: the fewest that keep to it; 0: free
  int own_texture = 0;              ///< texels of the longer side of the texture that can be kept; 0: none can
  bool avif = false;                ///< maps may be coded so
  bool needs_map = false;           ///< transparency or occlusion, which only a texture can hold
};

struct Trial {
  Recipe recipe;
  std::size_t bytes = 0, map_bytes = 0;  ///< of the file, and of the images in it
  int map_quality = 0;                   ///< that the map was coded with
  double error = 0;                      ///< MSE x 10^4
  double score = 0;                      ///< error x (1 - SSIM): visible facets, blocks and seams cost, too
};

/// A recipe that could not be carried out, for the history: nothing is worse.
Trial failed_trial(Recipe const& recipe);

/// The next thing to try; nothing when the search is over. Ends after five to thirty trials, seldom more; towards an error
/// questions are asked at two sizes, and landing may take nine more.
std::optional<Recipe> next_trial(Subject const& subject, FitOptions const& options, std::span<Trial const> history);

/// Index of the trial to publish, once the search is over.
/// Errors: NoSolution when no trial keeps within the limits, with the least that could be reached.
std::size_t best_trial(Subject const& subject, FitOptions const& options, std::span<Trial const> history);

}  // namespace vitrine
