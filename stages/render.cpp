// SPDX-License-Identifier: Apache-2.0
#include "stages/render.h"

#include "stages/depth_buffer.h"
#include "stages/face_lanes.h"
#include "stages/parallel.h"
#include "stages/shade.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>

namespace vitrine {
namespace {

constexpr int kMostLayers = 64;  ///< transparent ones that a ray passes before it sees the background
constexpr float kGrey = 0.5f;
constexpr std::size_t kManyFaces = 50'000;  ///< from here on, samples seldom share a face

/// One sample as the client's frame buffer holds it.
using Texel = std::array<std::uint8_t, 4>;
constexpr Texel kNothing{255, 255, 255, 0};

/// Rays through samples of a picture, side by side.
struct Rays {
  std::size_t count = 0;
  Lanes column, row;
};

/// A face before the eye: the place where a ray of direction d meets it is (d.u, d.v) / d.across.
struct SeenFace {
  Facet facet;
  V3f u, v;

  SeenFace() = default;
  SeenFace(Surface const& surface, std::uint32_t face, V3f const& eye) : facet(surface.facet(face)) {
    auto const& p = facet.corners;
    V3f const from_first = eye - p[0];
    u = from_first.cross(p[2] - p[0]), v = (p[1] - p[0]).cross(from_first);
  }

  /// Where rays meet the face; within it also where they pass by, by what the depth buffer rounds.
  /// `facing`: 1, or -1 where it is seen from behind.
  void meet(Rays const& rays, Lens const& lens, Places& at, Lanes& facing) const {
    Product const across(facet.across, lens), to_u(u, lens), to_v(v, lens);
    at.count = rays.count;
    for (std::size_t i = 0; i < rays.count; ++i) {
      float const column = rays.column[i], row = rays.row[i], slope = across(column, row), scale = 1 / slope;
      float const met_u = to_u(column, row) * scale, met_v = to_v(column, row) * scale;
      float const low_u = met_u > 0 ? met_u : 0, in_u = low_u < 1 ? low_u : 1;
      float const low_v = met_v > 0 ? met_v : 0, in_v = low_v < 1 - in_u ? low_v : 1 - in_u;
      at.u[i] = in_u, at.v[i] = in_v;
      facing[i] = slope > 0 ? -1.f : 1.f;
      at.step_u[0][i] = (to_u.right - in_u * across.right) * scale;
      at.step_v[0][i] = (to_v.right - in_v * across.right) * scale;
      at.step_u[1][i] = (to_u.down - in_u * across.down) * scale;
      at.step_v[1][i] = (to_v.down - in_v * across.down) * scale;
    }
  }

 private:
  /// Of a vector and the direction of rays: linear in column and row.
  struct Product {
    float top_left, right, down;

    Product(V3f const& with, Lens const& lens)
        : top_left(with.dot(lens.top_left)), right(with.dot(lens.right)), down(-with.dot(lens.up)) {}
    float operator()(float column, float row) const { return top_left + right * column + down * row; }
  };
};

/// The faces seen last, by the low bits of their number.
class SeenFaces {
 public:
  SeenFaces(Surface const& surface, V3f const& eye) : surface_(surface), eye_(eye) {}

  SeenFace const& operator[](std::uint32_t face) {
    SeenFace& seen = faces_[face % faces_.size()];
    if (seen.facet.face != face) std::construct_at(&seen, surface_, face, eye_);
    return seen;
  }

 private:
  Surface const& surface_;
  V3f eye_;
  std::array<SeenFace, 64> faces_;
};

/// Draws one view of one model.
class Painter {
 public:
  Painter(SurveyedModel const& model, Camera const& camera, PictureOptions const& options)
      : model_(model), options_(options), lens_(camera, model.model->origin, options.size * options.supersample) {
    V3d const to_light = options.light == Light::head ? -camera.forward : camera.up - camera.right - camera.forward;
    to_light_ = V3f(to_light.normalized());
    all_grey_ = options.grey && options.occlusion != Occlusion::colour;
    lanes_by_face_ = options.supersample * options.supersample == int(kLanes) && options.occlusion == Occlusion::none &&
                     model.model->mesh.triangles.size() >= kManyFaces && !model.model->normals.empty() &&
                     !model.surface.mapped() && !(options.grey && model.surface.unlit());
  }

  Image picture(DepthBuffer& buffer) const {
    Image picture{options_.size, options_.size, 4, ColourSpace::srgb, {}};
    for (int i = 0; i < options_.size * options_.size; ++i)
      picture.texels.insert(picture.texels.end(), kNothing.begin(), kNothing.end());
    if (model_.surface.alpha() == AlphaMode::opaque && buffer.draw(model_.model->mesh, lens_))
      draw_faces(buffer, picture);
    else
      trace(picture);
    return picture;
  }

 private:
  void draw_faces(DepthBuffer const& buffer, Image& picture) const {
    if (buffer.right() < buffer.left() || buffer.bottom() < buffer.top()) return;
    int const n = options_.supersample, top = buffer.top() / n, left = buffer.left() / n;
    parallel_blocks(std::size_t(buffer.bottom() / n - top + 1), 16, [&](std::size_t begin, std::size_t end) {
      SeenFaces faces(model_.surface, lens_.eye);
      for (std::size_t row = begin; row < end; ++row)
        for (int x = left, y = top + int(row); x <= buffer.right() / n; ++x) draw_pixel(picture, x, y, buffer, faces);
    });
  }

  /// The mean of a pixel's samples, which are lit side by side.
  void draw_pixel(Image& picture, int x, int y, DepthBuffer const& buffer, SeenFaces& faces) const {
    int const n = options_.supersample;
    std::array<std::uint32_t, kLanes> seen;
    for (int i = 0; i < n * n; ++i) seen[i] = buffer.face(n * x + i % n, n * y + i / n);
    Samples samples;
    std::size_t const covered = lanes_by_face_ ? look_at_samples(seen, x, y, samples) : look_at_faces(seen, x, y, faces, samples);
    if (covered == 0) return;
    shading_at(x, y)(samples);
    std::array<int, 4> sums;
    sums[0] = 255 * (n * n - int(covered)) + sum_of_srgb_bytes(samples.colour[0], covered);
    for (std::size_t k = 1; k < 3; ++k)
      sums[k] = all_grey_ ? sums[0] : 255 * (n * n - int(covered)) + sum_of_srgb_bytes(samples.colour[k], covered);
    sums[3] = 255 * int(covered);
    put(picture, x, y, sums);
  }

  /// Face by face; how many samples see one.
  std::size_t look_at_faces(std::array<std::uint32_t, kLanes>& seen, int x, int y, SeenFaces& faces, Samples& samples) const {
    std::size_t covered = 0;
    for (int i = 0; i < options_.supersample * options_.supersample; ++i) {
      if (seen[i] == DepthBuffer::kNothing) continue;
      SeenFace const& face = faces[seen[i]];
      covered = add(face, take(seen, i, x, y), samples, covered);
    }
    return covered;
  }

  /// Each sample with its own face.
  std::size_t look_at_samples(std::array<std::uint32_t, kLanes> const& seen, int x, int y, Samples& samples) const {
    int const n = options_.supersample;
    FaceLanes faces;
    Lanes column{}, row{};
    std::size_t covered = 0;
    std::uint32_t last = DepthBuffer::kNothing;
    for (int i = 0; i < n * n; ++i) {
      if (seen[i] == DepthBuffer::kNothing) continue;
      column[covered] = float(n * x + i % n), row[covered] = float(n * y + i / n);
      if (seen[i] == last) {
        faces.repeat(covered++);
        continue;
      }
      last = seen[i];
      if (!options_.grey || model_.model->materials.size() > 1) faces.set_colours(covered, model_.surface.facet(last));
      faces.set_shape(covered++, *model_.model, last, lens_.eye);
    }
    if (covered == 0) return 0;
    for (std::size_t i = covered; i < kLanes; ++i) faces.repeat(i);
    faces.look(lens_, column, row, options_.grey ? std::optional(kGrey) : std::nullopt, samples);
    return covered;
  }

  /// All samples of a pixel, from the first on, that see the same face as that; they are crossed out.
  Rays take(std::array<std::uint32_t, kLanes>& seen, int first, int x, int y) const {
    int const n = options_.supersample;
    std::uint32_t const face = seen[first];
    Rays rays;
    for (int i = first; i < n * n; ++i) {
      if (seen[i] != face) continue;
      seen[i] = DepthBuffer::kNothing;
      rays.column[rays.count] = float(n * x + i % n), rays.row[rays.count++] = float(n * y + i / n);
    }
    return rays;
  }

  /// Puts samples behind those that are there; how many there are then.
  std::size_t add(SeenFace const& seen, Rays const& rays, Samples& samples, std::size_t from) const {
    Places at;
    Lanes facing;
    seen.meet(rays, lens_, at, facing);
    SurfaceLanes surface;
    look_at(seen.facet, at, surface);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < at.count; ++i) {
        samples.colour[k][from + i] = surface.colour[k][i];
        samples.normal[k][from + i] = surface.normal[k][i] * facing[i];
      }
    std::copy_n(surface.occlusion.begin(), at.count, samples.open.begin() + from);
    std::fill_n(samples.lit.begin() + from, at.count, seen.facet.material->unlit ? 0.f : 1.f);
    return from + at.count;
  }

  /// The surface as the options want it drawn: grey in place of its colour, occluded or open.
  void look_at(Facet const& facet, Places const& at, SurfaceLanes& surface) const {
    model_.surface.sample(facet, at, surface);
    if (options_.occlusion != Occlusion::none && model_.occlusion)
      for (std::size_t i = 0; i < at.count; ++i)
        surface.occlusion[i] = model_.occlusion->at(model_.model->mesh, {facet.face, at.u[i], at.v[i]});
    bool const own_share = options_.occlusion == Occlusion::colour && !model_.occlusion;
    if (options_.grey)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < at.count; ++i) {
          float const share = options_.occlusion != Occlusion::colour ? 1 : own_share ? surface.colour[k][i] : surface.occlusion[i];
          surface.colour[k][i] = kGrey * share;
        }
    if (options_.occlusion != Occlusion::occlusion) surface.occlusion.fill(1);
  }

  /// Packets of rays, each for a square of pixels.
  void trace(Image& picture) const {
    int const side = int(std::sqrt(double(RayScene::kPacket))), n = options_.supersample, tile = side / n;
    std::size_t const rows = std::size_t((options_.size + tile - 1) / tile);
    parallel_for(rows, 8, [&](std::size_t row) {
      for (int left = 0, top = int(row) * tile; left < options_.size; left += tile) {
        std::array<Ray, RayScene::kPacket> rays;
        for (int i = 0; i < int(rays.size()); ++i)
          rays[i] = {lens_.eye, lens_.direction(float(left * n + i % side), float(top * n + i / side)), lens_.near, lens_.far};
        auto const hits = model_.scene.first_hits(rays);
        for (int y = top; y < std::min(top + tile, options_.size); ++y)
          for (int x = left; x < std::min(left + tile, options_.size); ++x) {
            Shading const shading = shading_at(x, y);
            std::array<int, 4> sums{};
            for (int i = 0; i < n * n; ++i) {
              std::size_t const ray = std::size_t(((y - top) * n + i / n) * side + (x - left) * n + i % n);
              Texel const texel = hits[ray] ? layers({1, {float(n * x + i % n)}, {float(n * y + i / n)}}, rays[ray], *hits[ray], shading) : kNothing;
              for (std::size_t k = 0; k < 4; ++k) sums[k] += texel[k];
            }
            put(picture, x, y, sums);
          }
      }
    });
  }

  /// All samples of a pixel are seen along the line through its middle.
  Shading shading_at(int x, int y) const {
    int const n = options_.supersample;
    float const middle = float(n - 1) / 2;
    return {-lens_.direction(float(n * x) + middle, float(n * y) + middle).normalized(), to_light_};
  }

  void put(Image& picture, int x, int y, std::array<int, 4> const& sums) const {
    int const samples = options_.supersample * options_.supersample;
    std::uint8_t* const pixel = &picture.texels[4 * (std::size_t(y) * std::size_t(options_.size) + std::size_t(x))];
    for (std::size_t k = 0; k < 4; ++k) pixel[k] = static_cast<std::uint8_t>((sums[k] + samples / 2) / samples);
  }

  /// What the ray shows from its first hit on: front to back, on white, in the client's encoded values.
  Texel layers(Rays const& sight, Ray ray, Hit hit, Shading const& shading) const {
    std::array<float, 3> shown{};
    float clear = 1;
    for (int layer = 0; layer < kMostLayers; ++layer) {
      Layer const at = look(sight, hit.face, shading);
      if (at.coverage >= 1 && clear == 1) return {at.bytes[0], at.bytes[1], at.bytes[2], 255};
      for (std::size_t k = 0; k < 3; ++k) shown[k] += clear * at.coverage * float(at.bytes[k]);
      clear *= 1 - at.coverage;
      if (clear <= 0) break;
      ray.near = std::nextafter(hit.distance, ray.far);
      std::optional<Hit> const behind = model_.scene.first_hit(ray);
      if (!behind) break;
      hit = *behind;
    }
    auto const byte = [](float value) { return static_cast<std::uint8_t>(std::lround(std::min(value, 255.0f))); };
    float const white = 255 * clear;
    return {byte(shown[0] + white), byte(shown[1] + white), byte(shown[2] + white), byte(255 - white)};
  }

  struct Layer {
    std::array<std::uint8_t, 3> bytes;
    float coverage;
  };

  Layer look(Rays const& sight, std::uint32_t face, Shading const& shading) const {
    SeenFace const seen(model_.surface, face, lens_.eye);
    Places at;
    Lanes facing;
    seen.meet(sight, lens_, at, facing);
    SurfaceLanes surface;
    look_at(seen.facet, at, surface);
    V3f const base(surface.colour[0][0], surface.colour[1][0], surface.colour[2][0]);
    V3f const normal = lane(surface.normal, 0) * facing[0];
    V3f const light = seen.facet.material->unlit ? base : shading(base, normal, surface.occlusion[0]);
    return {{srgb_byte(light.x), srgb_byte(light.y), srgb_byte(light.z)}, surface.colour[3][0]};
  }

  SurveyedModel const& model_;
  PictureOptions options_;
  Lens lens_;
  V3f to_light_;
  bool lanes_by_face_, all_grey_;
};

}  // namespace

std::vector<Image> render(SurveyedModel const& model, std::vector<Camera> const& cameras,
                          PictureOptions const& options) {
  std::vector<Image> pictures(cameras.size());
  constexpr std::size_t views_per_buffer = 2;  // what the system asks for fresh memory is a tenth of a view
  parallel_blocks(cameras.size(), views_per_buffer, [&](std::size_t begin, std::size_t end) {
    DepthBuffer buffer(options.size * options.supersample);
    for (std::size_t i = begin; i < end; ++i) pictures[i] = Painter(model, cameras[i], options).picture(buffer);
  });
  return pictures;
}

}  // namespace vitrine
