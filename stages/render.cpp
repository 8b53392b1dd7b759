// SPDX-License-Identifier: Apache-2.0
#include "stages/render.h"

#include "stages/closest_point.h"
#include "stages/depth_buffer.h"
#include "stages/parallel.h"
#include "stages/shade.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vitrine {
namespace {

constexpr int kMostLayers = 64;  ///< transparent ones that a ray passes before it sees the background
constexpr float kGrey = 0.5f;
constexpr std::size_t kMostFaces = std::size_t{1} << 20;  ///< beyond, a ray finds its face sooner than all are drawn

/// One sample as the client's frame buffer holds it.
using Texel = std::array<std::uint8_t, 4>;
constexpr Texel kNothing{255, 255, 255, 0};

/// A face before the eye: the place where a ray of direction d meets it is (d.u, d.v) / d.across.
struct SeenFace {
  Facet facet;
  V3f across, u, v;

  SeenFace() = default;
  SeenFace(Facet const& of, V3f const& eye) : facet(of) {
    auto const& p = facet.corners;
    V3f const b = p[1] - p[0], c = p[2] - p[0], from_first = eye - p[0];
    across = b.cross(c), u = from_first.cross(c), v = b.cross(from_first);
  }

  /// Within the face also where the ray passes by, by what the depth buffer rounds.
  Barycentric at(V3f const& direction, float slope) const {
    float const place_u = direction.dot(u) / slope, place_v = direction.dot(v) / slope;
    if (place_u >= 0 && place_v >= 0 && place_u + place_v <= 1) return {place_u, place_v};
    auto const share = [](float place) { return place > 0 ? std::min(place, 1.f) : 0; };
    float const share_u = share(place_u);
    return {share_u, std::min(share(place_v), 1 - share_u)};
  }

  /// By how much the place moves with the direction.
  Barycentric moved(Barycentric const& at, float slope, V3f const& step) const {
    float const moved_slope = step.dot(across);
    return {(step.dot(u) - at.u * moved_slope) / slope, (step.dot(v) - at.v * moved_slope) / slope};
  }
};

/// The faces seen last, by the low bits of their number.
class SeenFaces {
 public:
  SeenFaces(Surface const& surface, V3f const& eye) : surface_(surface), eye_(eye) {}

  SeenFace const& operator[](std::uint32_t face) {
    SeenFace& seen = faces_[face % faces_.size()];
    if (seen.facet.face != face) seen = {surface_.facet(face), eye_};
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
  }

  Image picture(DepthBuffer& buffer) const {
    Image picture{options_.size, options_.size, 4, ColourSpace::srgb, {}};
    for (int i = 0; i < options_.size * options_.size; ++i)
      picture.texels.insert(picture.texels.end(), kNothing.begin(), kNothing.end());
    if (first_face_is_all() && buffer.draw(model_.model->mesh, lens_))
      draw_faces(buffer, picture);
    else
      trace(picture);
    return picture;
  }

 private:
  bool first_face_is_all() const {
    return model_.surface.alpha() == AlphaMode::opaque && model_.model->mesh.triangles.size() <= kMostFaces;
  }

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
    Samples samples;
    std::size_t covered = 0;
    for (int i = 0; i < n * n; ++i) {
      int const column = n * x + i % n, row = n * y + i / n;
      std::uint32_t const face = buffer.face(column, row);
      if (face == DepthBuffer::kNothing) continue;
      add(faces[face], lens_.direction(float(column), float(row)), samples, covered++);
    }
    if (covered == 0) return;
    shading_at(x, y)(samples);
    std::array<int, 4> sums;
    for (std::size_t k = 0; k < 3; ++k) {
      sums[k] = 255 * (n * n - int(covered));
      for (std::size_t i = 0; i < covered; ++i) sums[k] += srgb_byte(samples.colour[k][i]);
    }
    sums[3] = 255 * int(covered);
    put(picture, x, y, sums);
  }

  void add(SeenFace const& seen, V3f const& direction, Samples& samples, std::size_t i) const {
    float const slope = direction.dot(seen.across);
    Barycentric const at = seen.at(direction, slope);
    SurfaceSample const surface = sample(seen, at, slope);
    for (int k = 0; k < 3; ++k) {
      samples.colour[k][i] = options_.grey ? kGrey : surface.colour[k];
      samples.normal[k][i] = slope > 0 ? -surface.normal[k] : surface.normal[k];
    }
    samples.lit[i] = seen.facet.material->unlit ? 0 : 1;
  }

  SurfaceSample sample(SeenFace const& seen, Barycentric const& at, float slope) const {
    std::array<Barycentric, 2> steps;
    if (seen.facet.mapped) steps = {seen.moved(at, slope, lens_.right), seen.moved(at, slope, lens_.up)};
    return model_.surface.sample(seen.facet, at, steps);
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
              Texel const texel = hits[ray] ? layers(rays[ray], *hits[ray], shading) : kNothing;
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
  Texel layers(Ray ray, Hit hit, Shading const& shading) const {
    std::array<float, 3> shown{};
    float clear = 1;
    for (int layer = 0; layer < kMostLayers; ++layer) {
      Layer const at = look(ray.direction, hit, shading);
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

  Layer look(V3f const& direction, Hit const& hit, Shading const& shading) const {
    SeenFace const seen(model_.surface.facet(hit.face), lens_.eye);
    float const slope = direction.dot(seen.across);
    SurfaceSample const surface = sample(seen, {hit.u, hit.v}, slope);
    V3f const base = options_.grey ? V3f(kGrey) : V3f(surface.colour[0], surface.colour[1], surface.colour[2]);
    V3f const light =
        seen.facet.material->unlit ? base : shading(base, slope > 0 ? -surface.normal : surface.normal);
    return {{srgb_byte(light.x), srgb_byte(light.y), srgb_byte(light.z)}, surface.colour[3]};
  }

  SurveyedModel const& model_;
  PictureOptions options_;
  Lens lens_;
  V3f to_light_;
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
