// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The values on the edges of the pipeline, in the order in which they are made.
///
/// Conventions, stated once:
/// - right-handed axes, +Y up; front faces counter-clockwise seen from outside; lengths in the model's own unit
/// - texture coordinates as in glTF: u right, v down, (0,0) the outer corner of the top left texel; images store the
///   top row first
/// - colours are sRGB in 8-bit images whose `space` says so, linear everywhere else
/// - every type owns its arrays; what one stage returns is immutable for the next

#include <Imath/ImathBox.h>
#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vitrine {

using Imath::Box3f;
using Imath::V2f;
using Imath::V3d;
using Imath::V3f;
using Imath::V4f;

using Triangle = std::array<std::uint32_t, 3>;
using CornerUvs = std::array<V2f, 3>;
using Rgba16 = std::array<std::uint16_t, 4>;  ///< linear colour and coverage, 65535 = 1
using Rgba = std::array<float, 4>;            ///< linear colour and coverage

/// Triangles over shared vertices. n vertices, f faces.
struct TriMesh {
  std::vector<V3f> positions;       ///< n
  std::vector<Triangle> triangles;  ///< f, each index below n
};

Box3f bounds(TriMesh const& mesh);

enum class ColourSpace { srgb, linear };

/// 8-bit image of 1 (grey), 2 (grey, alpha), 3 (RGB) or 4 (RGBA) channels, interleaved; alpha is never premultiplied.
struct Image {
  int width = 0, height = 0, channels = 0;
  ColourSpace space = ColourSpace::srgb;
  std::vector<std::uint8_t> texels;  ///< height x width x channels
};

/// The colours of an RGBA picture that was drawn on a background, without its coverage.
Image opaque(Image const& picture);

enum class Wrap { repeat, mirror, clamp };

/// What is read between the middles of texels.
enum class Filter { linear, nearest };

/// Use of an image by a material; maps the vertex's uv to the image's: (u, v) -> matrix * (u, v, 1).
struct TextureUse {
  int image = -1;  ///< index into SourceModel::images; -1: none
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  Filter magnified = Filter::linear, minified = Filter::linear;  ///< where it is drawn larger and smaller than it is
  bool mipmapped = true;  ///< clients read smaller versions where it is far away; else the image itself, which flickers
  std::array<float, 6> matrix{1, 0, 0, 0, 1, 0};  ///< 2 x 3, row by row
};

enum class AlphaMode { opaque, mask, blend };

struct Material {
  std::string name;
  Rgba base_colour{1, 1, 1, 1};  ///< multiplies texture and vertex colour
  bool coloured = false;         ///< the file gives this material a colour, by factor or texture
  TextureUse colour_map;         ///< sRGB
  TextureUse normal_map;         ///< tangent space, glTF's orientation
  float normal_scale = 1;
  V3f emission{0, 0, 0};     ///< linear; light of its own, times the map
  TextureUse emission_map;   ///< sRGB
  TextureUse occlusion_map;  ///< linear, in the first channel
  float occlusion_strength = 1;
  AlphaMode alpha = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  bool unlit = false;
  bool double_sided = false;
};

/// What an archive holds: one model as read, all parts in one space, vertices split where attributes differ.
struct SourceModel {
  TriMesh mesh;
  V3d origin{0, 0, 0};                        ///< added to every position; not 0 only where float would lose detail
  std::vector<V3f> normals;                   ///< n, unit; empty: the file gives none
  std::vector<V4f> tangents;                  ///< n; unit, w the side of the bitangent (1, -1), zero: none; empty: none
  std::vector<V2f> uvs;                       ///< n; empty: none
  std::vector<Rgba16> colours;                ///< n; empty: none
  std::vector<std::uint16_t> face_materials;  ///< f, index into materials; empty: all faces use materials[0]
  std::vector<Material> materials{Material{}};  ///< at least one
  std::vector<Image> images;
  std::vector<std::string> notes;  ///< what was ambiguous, missing or repaired, in words, for the report
};

/// Whether the original is drawn in colours of its own; one without any gets no baked base colour.
bool has_colour(SourceModel const& model);

inline bool emits(Material const& material) { return material.emission != V3f(0) && !material.unlit; }

enum class StopReason { target_reached, error_limit, nothing_left };

/// The light mesh: positions welded, possibly non-manifold where the original is.
struct SimplifiedMesh {
  TriMesh mesh;
  float error = 0;  ///< root of the largest quadric error accepted, as a share of the bounding box's diagonal
  StopReason stop = StopReason::target_reached;
  std::vector<CornerUvs> corner_uvs{};  ///< f, of the original's own texture where that is kept; else empty
};

/// c charts; every face in exactly one; each chart a topological disk, connected over manifold edges.
struct ChartedMesh {
  TriMesh mesh;
  std::vector<std::uint32_t> face_charts;  ///< f, below `charts`
  std::uint32_t charts = 0;
};

/// Charts laid flat, each on its own.
struct FlatCharts {
  TriMesh mesh;
  std::vector<std::uint32_t> face_charts;
  std::uint32_t charts = 0;
  std::vector<CornerUvs> corner_uvs;  ///< f, chart-local, model units; each chart's area equals its area in space
  std::vector<float> stretch;         ///< c, L2 stretch of Sander et al. 2001 (1: isometric)
  std::uint32_t retries = 0;          ///< charts that were split because the first map folded or overlapped
};

/// All charts in one texture.
struct Atlas {
  TriMesh mesh;
  std::vector<std::uint32_t> face_charts;
  std::uint32_t charts = 0;
  std::vector<CornerUvs> corner_uvs;  ///< f, in [0,1]
  int width = 0, height = 0;          ///< texels
  int gutter = 0;                     ///< texels kept free between any two charts
  float fill = 0;                     ///< share of the texels that charts cover
};

/// Grid on which a file stores its vertices: value = origin + integer * step. An axis-aligned cube for positions, the
/// unit square for texture coordinates, the unit cube for colours.
struct Grid {
  V3f origin{0, 0, 0};
  float range = 1;  ///< edge of the cube
  int position_bits = 0, uv_bits = 0, normal_bits = 0, colour_bits = 0;
};

/// An atlas whose positions and texture coordinates lie exactly on the grid that the file stores,
/// so that what is baked fits what a client decodes.
struct QuantizedAtlas {
  Atlas atlas;
  Grid grid;
};

struct BakeStatistics {
  std::uint64_t texels = 0;   ///< covered by charts
  std::uint64_t samples = 0;  ///< rays' origins
  std::uint64_t misses = 0;   ///< samples where no ray met the original with the same orientation: closest point used
};

/// Everything that a thumbnail shows.
struct BakedModel {
  TriMesh mesh;
  std::vector<CornerUvs> corner_uvs;  ///< f, in the unit square; empty when there is no map
  V2f uv_offset{0, 0},
      uv_scale{1,
               1};  ///< `colour` is read at offset + scale * uv; others than these for a texture of the original alone
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  std::vector<V3f> normals;                ///< n, unit; empty: drawn flat, never with a normal map
  std::vector<V3f> colours;                ///< n, linear, in [0,1], multiplied by base_colour; empty: none
  std::vector<std::uint32_t> face_charts;  ///< f, index into chart_tangents; empty when there is no normal map
  std::vector<V3f> chart_tangents;         ///< c, each +X, +Y or +Z; glTF's TANGENT of all the chart's vertices, w = 1
  V3d origin{0, 0, 0};
  Grid grid;
  Rgba base_colour{1, 1, 1, 1};  ///< multiplies colour map and vertex colours; alone for models of one colour
  std::optional<Image> colour;   ///< sRGB, 3 or 4 channels
  bool palette = false;         ///< `colour` lists colours that corners pick by their uvs, see palette.h and swatches.h
  std::optional<Image> normal;  ///< tangent space of chart_tangents, 3 channels, linear
  std::optional<Image> derived_normal;  ///< the same normals for clients that build the frame without TANGENT
  std::optional<Image> occlusion;       ///< 1 channel, linear
  AlphaMode alpha = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  bool unlit = false;
  bool double_sided = false;
  BakeStatistics statistics;
};

struct NamedFile {
  std::string name;
  std::vector<std::byte> bytes;
};

/// A finished file and what its bytes are spent on. The parts add up to glb.size().
struct EncodedThumbnail {
  std::vector<std::byte> glb;
  std::vector<NamedFile> x3d;      ///< the same for X3DOM, a page and what it needs; where that was asked for
  std::vector<std::byte> x3d_zip;  ///< all of it in one file
  std::size_t geometry = 0, colour = 0, normal = 0, occlusion = 0, other = 0;
  std::uint32_t triangles = 0, vertices = 0;  ///< as drawn: vertices split at seams
  int colour_quality = 0;                     ///< of 100, that the colour map was coded with; 0 without one
  std::optional<Image> normal_map;            ///< as clients decode it
};

/// Each check lists what is violated, in words; an empty list means valid. Tests and debug builds use them.
std::vector<std::string> check(TriMesh const& mesh);
std::vector<std::string> check(SourceModel const& model);
std::vector<std::string> check(ChartedMesh const& charts);
std::vector<std::string> check(FlatCharts const& charts);
std::vector<std::string> check(Atlas const& atlas);

}  // namespace vitrine
