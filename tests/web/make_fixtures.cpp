// SPDX-License-Identifier: Apache-2.0
/// Writes small thumbnails in all profiles, and fixtures.json: what a client must show of each.
/// The client looks along -z at `centre`, orthographically, at a square of edge 2.5; light comes from `light`, or from
/// everywhere when there is none. Pixels are named by their place in the model's xy plane.

#include "io/publish.h"
#include "io/write_glb.h"
#include "stages/tangent_frame.h"
#include "tests/support/delivered.h"
#include "tests/support/meshes.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

namespace vitrine {
namespace {

using Json = nlohmann::ordered_json;

struct Fixture {
  std::string name;
  BakedModel model;
  Json expect;
};

Image plain_image(int size, std::vector<std::uint8_t> texel, ColourSpace space) {
  Image image{size, size, static_cast<int>(texel.size()), space, {}};
  for (int i = 0; i < size * size; ++i) image.texels.insert(image.texels.end(), texel.begin(), texel.end());
  return image;
}

/// Fills the square of edge 2 about the origin of the xy plane; faces +z; its texture stands upright.
BakedModel quad() {
  BakedModel model;
  model.mesh = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  model.corner_uvs = {{V2f{0, 1}, {1, 1}, {1, 0}}, {V2f{0, 1}, {1, 0}, {0, 0}}};
  model.normals.assign(4, {0, 0, 1});
  model.grid = {{-1, -1, -1}, 2, 11, 11, 8};
  model.colour = plain_image(32, {255, 255, 255}, ColourSpace::srgb);
  return model;
}

Json pixel(double x, double y, std::vector<int> rgb, int within = 3) {
  return {{"at", {x, y}}, {"rgb", rgb}, {"within", within}};
}

/// Red, green, blue and white from the top left, row by row: shown upright and not mirrored, in its own colours.
Fixture unlit() {
  BakedModel model = quad();
  model.unlit = true;
  Image& image = *model.colour;
  for (std::size_t i = 0; i < 32 * 32; ++i) {
    bool const right = i % 32 >= 16, bottom = i / 32 >= 16;
    image.texels[3 * i] = right == bottom ? 255 : 0;
    image.texels[3 * i + 1] = right ? 255 : 0;
    image.texels[3 * i + 2] = bottom ? 255 : 0;
  }
  return {"unlit",
          model,
          {{"coverage", 0.64},
           {"light", {0, 0, 1}},
           {"pixels",
            {pixel(-0.5, 0.5, {255, 0, 0}), pixel(0.5, 0.5, {0, 255, 0}), pixel(-0.5, -0.5, {0, 0, 255}),
             pixel(0.5, -0.5, {255, 255, 255})}}}};
}

/// The left half is cut out, but for a quarter of a texel at either end (cutoff 0.25; textures repeat): 16.5 of 32
/// remain.
Fixture cut_out() {
  BakedModel model = quad();
  model.alpha = AlphaMode::mask;
  model.alpha_cutoff = 0.25f;
  model.double_sided = true;
  model.colour = plain_image(32, {200, 100, 50, 255}, ColourSpace::srgb);
  for (std::size_t i = 0; i < 32 * 32; ++i)
    if (i % 32 < 16) model.colour->texels[4 * i + 3] = 0;
  return {"cut_out", model, {{"coverage", 0.33}, {"pixels", {pixel(0.5, 0, {200, 100, 50})}}}};
}

/// Ambient light reaches half of it: linear 0.5 is 188 in sRGB.
Fixture occluded() {
  BakedModel model = quad();
  model.colour.reset();
  model.occlusion = plain_image(32, {128}, ColourSpace::linear);
  return {"occluded", model, {{"coverage", 0.64}, {"pixels", {pixel(0, 0, {188, 188, 188})}}}};
}

/// Colours at the corners, flat: mixed in linear light, a quarter, a half and a quarter, and halved by the factor.
Fixture painted() {
  BakedModel model = quad();
  model.colour.reset();
  model.corner_uvs.clear();
  model.normals.clear();
  model.unlit = true;
  model.base_colour = {0.5f, 0.5f, 0.5f, 1};
  model.grid.colour_bits = 5;
  model.colours = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  return {"painted", model, {{"coverage", 0.64}, {"light", {0, 0, 1}}, {"pixels", {pixel(0.5, -0.5, {99, 137, 99})}}}};
}

/// A sphere of colours per vertex without normals: facets, lit.
Fixture painted_facets() { return {"painted_facets", test::coloured_model(3), {{"light", {0, 0, 1}}}}; }

/// Vertices that name colours from all along two red rows of a palette that is blue otherwise: clients that read a
/// smaller version of it show purple.
Fixture palette() {
  BakedModel model = test::random_model(5, 160, 80);
  model.chart_tangents.clear();
  model.normals.clear();
  model.unlit = model.palette = true;
  model.colour = plain_image(8, {0, 0, 255}, ColourSpace::srgb);
  for (std::size_t i = 3 * 8; i < 3 * 8 * 3; i += 3) {
    model.colour->texels[i] = 255;
    model.colour->texels[i + 2] = 0;
  }
  model.grid.uv_bits = 4;
  for (std::size_t f = 0; f < model.mesh.triangles.size(); ++f)
    for (std::size_t c = 0; c < 3; ++c)
      model.corner_uvs[f][c] = {float(model.mesh.triangles[f][c] % 2 ? 14 : 1) * (1.f / 15), 4 * (1.f / 15)};
  return {
      "palette", model, {{"light", {0, 0, 1}}, {"pixels", {pixel(0, 0, {255, 0, 0}), pixel(0.5, 0.3, {255, 0, 0})}}}};
}

/// A cube of linear colour 0.2 (124 in sRGB) without any map.
Fixture cube(std::string name, V3d const& origin) {
  BakedModel model;
  model.mesh = test::cube();
  model.grid = {{-1, -1, -1}, 2, 12, 12, 8};
  model.base_colour = {0.2f, 0.2f, 0.2f, 1};
  model.origin = origin;
  return {std::move(name), model, {{"coverage", 0.16}, {"pixels", {pixel(0, 0, {124, 124, 124})}}}};
}

/// How a quad lies in its texture: (u, v) = (1/2, 1/2) + matrix * (x, y).
struct Chart {
  char const* name;
  float matrix[4];
  V3f tangent;
};
constexpr Chart kCharts[] = {{"straight", {0.4f, 0, 0, -0.4f}, {1, 0, 0}},
                             {"mirrored", {-0.4f, 0, 0, -0.4f}, {0, 1, 0}},
                             {"turned", {0.15f, 0.26f, 0.26f, -0.15f}, {1, 0, 0}},
                             {"sheared", {0.3f, 0.2f, 0.05f, -0.15f}, {0, 1, 0}}};

/// A quad whose normal map says, in the frame of a tangent that is not orthogonal to its normals, that it is tilted;
/// drawn with vertex normals that lean elsewhere, or with the facets' own. It must shade as a surface with that normal.
Fixture tilted(Chart const& chart, bool flat) {
  BakedModel model = quad();
  for (std::size_t f = 0; f < 2; ++f)
    for (std::size_t c = 0; c < 3; ++c) {
      V3f const& p = model.mesh.positions[model.mesh.triangles[f][c]];
      float const* m = chart.matrix;
      model.corner_uvs[f][c] = V2f(0.5f + m[0] * p.x + m[1] * p.y, 0.5f + m[2] * p.x + m[3] * p.y);
    }
  V3f const normal = flat ? V3f(0, 0, 1) : V3f(-0.2f, 0.1f, 1).normalized();
  V3f const wanted = V3f(0.35f, 0.2f, 1).normalized();
  model.normals.assign(4, normal);
  model.face_charts = {0, 0};
  model.chart_tangents = {chart.tangent};
  V3f const m = to_tangent_space(stored_frame(normal, chart.tangent), wanted);
  std::vector<std::uint8_t> texel;
  for (unsigned k = 0; k < 3; ++k) texel.push_back(static_cast<std::uint8_t>(std::lround(127.5f + 127.5f * m[k])));
  model.colour = plain_image(32, {200, 200, 200}, ColourSpace::srgb);
  model.normal = plain_image(32, texel, ColourSpace::linear);
  return {
      std::string(chart.name) + (flat ? "_flat" : "_smooth"),
      model,
      {{"coverage", 0.64}, {"light", {0.9, -0.5, 0.5}}, {"shadesAs", {wanted.x, wanted.y, wanted.z}}, {"within", 2}}};
}

Fixture charts() {
  BakedModel model = test::random_model(7, 64, 32);
  model.chart_tangents.clear();
  model.colour = plain_image(64, {180, 90, 45}, ColourSpace::srgb);
  return {"charts", model, {{"pixels", {pixel(0, 0, {180, 90, 45})}}}};
}

}  // namespace
}  // namespace vitrine

int main(int count, char** arguments) {
  using namespace vitrine;
  if (count != 2) {
    std::cerr << "usage: make_fixtures FOLDER\n";
    return 2;
  }
  std::filesystem::path const folder = arguments[1];
  std::vector<Fixture> fixtures{unlit(),
                                cut_out(),
                                occluded(),
                                charts(),
                                painted(),
                                painted_facets(),
                                palette(),
                                cube("cube", {0, 0, 0}),
                                cube("far_cube", {4e6, -5e5, 3e6 + 0.125})};
  for (Chart const& chart : kCharts)
    for (bool flat : {false, true}) fixtures.push_back(tilted(chart, flat));
  Json expected = Json::array();
  for (Fixture const& fixture : fixtures)
    for (Profile profile : {Profile::web, Profile::plain, Profile::meshopt, Profile::core}) {
      std::string const file =
          fixture.name + "." + std::string(EnumNames<Profile>::names[static_cast<std::size_t>(profile)]) + ".glb";
      io::publish_file(folder / file, io::encode(fixture.model, fixture.name,
                                                 {.profile = profile, .colour_quality = 90, .normal_quality = 90})
                                          .glb);
      Json entry = fixture.expect;
      entry["file"] = file;
      entry["centre"] = {fixture.model.origin.x, fixture.model.origin.y, fixture.model.origin.z};
      expected.push_back(entry);
    }
  io::publish_file(folder / "fixtures.json", expected.dump(1));
}
