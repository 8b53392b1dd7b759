// SPDX-License-Identifier: Apache-2.0
#include "stages/looks.h"

#include <algorithm>

namespace vitrine {
namespace {

using Materials = std::vector<std::uint16_t>;

Materials materials_in_use(SourceModel const& model) {
  if (model.face_materials.empty()) return {0};
  std::vector<bool> used(model.materials.size(), false);
  for (std::uint16_t m : model.face_materials) used[m] = true;
  Materials in_use;
  for (std::size_t m = 0; m < used.size(); ++m)
    if (used[m]) in_use.push_back(static_cast<std::uint16_t>(m));
  return in_use;
}

bool all_equal(std::vector<Rgba16> const& colours) {
  return std::all_of(colours.begin(), colours.end(), [&](Rgba16 const& c) { return c == colours[0]; });
}

Rgba colour_of(SourceModel const& model, Material const& material) {
  Rgba colour = material.base_colour;
  if (!model.colours.empty())
    for (std::size_t k = 0; k < 4; ++k) colour[k] *= float(model.colours[0][k]) / 65535;
  if (emits(material)) colour = with_emission(colour, material.emission);
  colour[3] = coverage(material, colour[3]);
  return colour;
}

bool blends_mostly(SourceModel const& model) {
  double all = 0, blending = 0;
  for (std::size_t f = 0; f < model.mesh.triangles.size(); ++f) {
    auto const [a, b, c] = model.mesh.triangles[f];
    V3f const corner = model.mesh.positions[a];
    double const area = (model.mesh.positions[b] - corner).cross(model.mesh.positions[c] - corner).length();
    all += area;
    Material const& material = model.materials[model.face_materials.empty() ? 0 : model.face_materials[f]];
    if (material.alpha == AlphaMode::blend) blending += area;
  }
  return blending > all / 2;
}

}  // namespace

Looks::Looks(SourceModel const& model) : in_use(materials_in_use(model)) {
  auto const any = [&](auto const& is_so) {
    return std::any_of(in_use.begin(), in_use.end(), [&](std::uint16_t m) { return is_so(model.materials[m]); });
  };
  auto const is = [](AlphaMode mode) { return [mode](Material const& m) { return m.alpha == mode; }; };
  auto const has_map = [](Material const& m) { return m.colour_map.image >= 0 || m.emission_map.image >= 0; };
  Material const& first = model.materials[in_use[0]];
  auto const differs = [&](Material const& m) {
    return (has_map(m) && !model.uvs.empty()) || m.base_colour != first.base_colour || m.emission != first.emission;
  };
  unlit = !any([](Material const& m) { return !m.unlit; });
  emissive = any([](Material const& m) { return emits(m); });
  double_sided = any([](Material const& m) { return m.double_sided; });
  mapped = !model.uvs.empty() &&
           any([&](Material const& m) { return has_map(m) || m.normal_map.image >= 0 || m.occlusion_map.image >= 0; });
  if (has_colour(model)) {
    coloured = (!model.colours.empty() && !all_equal(model.colours)) || any(differs);
    uniform_colour = colour_of(model, first);
  }
  AlphaMode const without_blending = any(is(AlphaMode::mask)) ? AlphaMode::mask : AlphaMode::opaque;
  alpha = any(is(AlphaMode::blend)) ? AlphaMode::blend : without_blending;
  common_alpha = alpha == AlphaMode::blend && !blends_mostly(model) ? without_blending : alpha;
}

float coverage(Material const& material, float alpha) {
  if (material.alpha == AlphaMode::opaque) return 1;
  if (material.alpha == AlphaMode::mask) return alpha >= material.alpha_cutoff ? 1 : 0;
  return std::clamp(alpha, 0.f, 1.f);
}

Rgba with_emission(Rgba colour, V3f const& emission) {
  constexpr float kUsualLight = 0.8f;
  for (unsigned k = 0; k < 3; ++k) colour[k] = std::min(colour[k] + emission[k] / kUsualLight, 1.f);
  return colour;
}

}  // namespace vitrine
