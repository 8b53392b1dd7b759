// SPDX-License-Identifier: Apache-2.0
#include "stages/render.h"

#include "stages/depth_buffer.h"
#include "stages/face_lanes.h"
#include "stages/parallel.h"
#include "stages/seen_face.h"
#include "stages/shade.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vitrine {
namespace {

constexpr int kMostLayers = 64;  ///< transparent ones that a ray passes before it sees the background
constexpr float kGrey = 0.5f;
constexpr std::size_t kManyFaces = 50'000;  ///< from here on, samples seldom share a face
constexpr int kBlock = 4;                   ///< samples that are lit side by side are a square of so many
static_assert(kBlock * kBlock == kLanes);

/// One sample as the client's frame buffer holds it.
using Texel = std::array<std::uint8_t, 4>;
constexpr Texel kNothing{255, 255, 255, 0};

/// Draws one view of one model.
class Painter {
 public:
  Painter(SurveyedModel const& model, Camera const& camera, PictureOptions const& options)
      : model_(model), options_(options), lens_(camera, model.model->origin, options.size * options.supersample) {
    V3d const to_light = options.light == Light::head ? -camera.forward : camera.up - camera.right - camera.forward;
    to_light_ = V3f(to_light.normalized());
    all_grey_ = options.grey && options.occlusion != Occlusion::colour;
    block_ = kBlock / options.supersample;
    int const n = options.supersample, side = block_ * n;
    for (int i = 0; i < side * side; ++i)
      spots_[std::size_t(i)] = {i % side, i / side, std::size_t(i / side / n * block_ + i % side / n)};
    lanes_by_face_ = kBlock % options.supersample == 0 && options.occlusion == Occlusion::none &&
                     model.model->mesh.triangles.size() >= kManyFaces && !model.model->normals.empty() &&
                     !model.surface.mapped() && !model.surface.emissive() && !(options.grey && model.surface.unlit());
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
  /// Some pixels, as many as have a lane for each of their samples.
  struct Block {
    int x, y;                                 ///< first pixel
    std::size_t covered = 0;                  ///< samples that see a face; those come first below
    std::array<std::uint8_t, kLanes> places;  ///< in the block
    Samples samples;
    LaneVector<3> emission;  ///< where the surface emits
  };
  /// Where a sample lies in its block.
  struct Spot {
    int column, row;
    std::size_t pixel;
  };
  using Seen = std::array<std::uint32_t, kLanes>;  ///< faces, by the samples' places

  void draw_faces(DepthBuffer const& buffer, Image& picture) const {
    if (buffer.right() < buffer.left() || buffer.bottom() < buffer.top()) return;
    int const side = block_ * options_.supersample, top = buffer.top() / side, left = buffer.left() / side;
    auto const draw_rows = [&](std::size_t begin, std::size_t end) {
      SeenFaces faces(model_.surface, lens_.eye);
      for (int row = top + int(begin); row < top + int(end); ++row)
        for (int column = left; column <= buffer.right() / side; ++column)
          draw_block(picture, column * block_, row * block_, buffer, faces);
    };
    parallel_blocks(std::size_t(buffer.bottom() / side - top + 1), std::size_t(16 / block_), draw_rows);
  }

  /// Pixels are the means of their samples.
  void draw_block(Image& picture, int x, int y, DepthBuffer const& buffer, SeenFaces& faces) const {
    int const n = options_.supersample, side = block_ * n;
    Seen seen;
    for (int i = 0; i < side * side; ++i) seen[i] = buffer.face(n * x + spots_[i].column, n * y + spots_[i].row);
    Block block{x, y, 0, {}, {}, {}};
    if (lanes_by_face_)
      look_at_samples(seen, block);
    else
      look_at_faces(seen, faces, block);
    if (block.covered == 0) return;
    shading_at(x, y, block_)(block.samples);
    if (model_.surface.emissive()) shine(block);
    put(picture, block);
  }

  static void shine(Block& block) {
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < block.covered; ++i) block.samples.colour[k][i] += block.emission[k][i];
  }

  void put(Image& picture, Block const& block) const {
    int const n = options_.supersample;
    std::array<std::array<int, 4>, kLanes> sums;
    sums.fill({255 * n * n, 255 * n * n, 255 * n * n, 0});
    for (std::size_t i = 0; i < block.covered; ++i) {
      auto& [r, g, b, covered] = sums[spots_[block.places[i]].pixel];
      auto const& colour = block.samples.colour;
      int const red = srgb_byte(colour[0][i]) - 255;
      r += red;
      g += all_grey_ ? red : srgb_byte(colour[1][i]) - 255;
      b += all_grey_ ? red : srgb_byte(colour[2][i]) - 255;
      covered += 255;
    }
    for (int i = 0; i < block_ * block_; ++i)
      if (sums[std::size_t(i)][3] > 0) put(picture, block.x + i % block_, block.y + i / block_, sums[std::size_t(i)]);
  }

  /// Face by face.
  void look_at_faces(Seen& seen, SeenFaces& faces, Block& block) const {
    int const side = block_ * options_.supersample;
    for (int i = 0; i < side * side; ++i)
      if (seen[i] != DepthBuffer::kNothing) {
        SeenFace const& face = faces[seen[i]];
        add(face, take(seen, i, block), block);
      }
  }

  /// Each sample with its own face.
  void look_at_samples(Seen const& seen, Block& block) const {
    FaceLanes faces;
    Rays rays;
    std::uint32_t last = DepthBuffer::kNothing;
    for (int i = 0; i < int(kLanes); ++i) {
      if (seen[i] == DepthBuffer::kNothing) continue;
      block.places[rays.count] = std::uint8_t(i);
      aim(rays, i, block);
      if (seen[i] == last) {
        faces.repeat(rays.count - 1);
        continue;
      }
      last = seen[i];
      if (!options_.grey || model_.model->materials.size() > 1)
        faces.set_colours(rays.count - 1, model_.surface.facet(last));
      faces.set_shape(rays.count - 1, *model_.model, last, lens_.eye);
    }
    block.covered = rays.count;
    if (rays.count == 0) return;
    for (std::size_t i = rays.count; i < kLanes; ++i) faces.repeat(i), rays.column[i] = rays.row[i] = 0;
    faces.look(lens_, rays.column, rays.row, options_.grey ? std::optional(kGrey) : std::nullopt, block.samples);
  }

  /// All samples of a block, from the first on, that see the same face as that; they are crossed out.
  Rays take(Seen& seen, int first, Block& block) const {
    int const side = block_ * options_.supersample;
    std::uint32_t const face = seen[first];
    Rays rays;
    for (int i = first; i < side * side; ++i) {
      if (seen[i] != face) continue;
      seen[i] = DepthBuffer::kNothing;
      block.places[block.covered + rays.count] = std::uint8_t(i);
      aim(rays, i, block);
    }
    return rays;
  }

  /// One more ray, through a sample of the block.
  void aim(Rays& rays, int place, Block const& block) const {
    int const n = options_.supersample;
    Spot const& spot = spots_[std::size_t(place)];
    rays.column[rays.count] = float(n * block.x + spot.column);
    rays.row[rays.count++] = float(n * block.y + spot.row);
  }

  /// Puts samples behind those that are there.
  void add(SeenFace const& seen, Rays const& rays, Block& block) const {
    Places at;
    Lanes facing;
    seen.meet(rays, lens_, at, facing);
    SurfaceLanes surface;
    look_at(seen.facet, at, surface);
    std::size_t const from = block.covered;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < at.count; ++i) {
        block.samples.colour[k][from + i] = surface.colour[k][i];
        block.samples.normal[k][from + i] = surface.normal[k][i] * facing[i];
      }
    if (model_.surface.emissive())
      for (std::size_t k = 0; k < 3; ++k)
        std::copy_n(surface.emission[k].begin(), at.count, block.emission[k].begin() + from);
    std::copy_n(surface.occlusion.begin(), at.count, block.samples.open.begin() + from);
    std::fill_n(block.samples.lit.begin() + from, at.count, seen.facet.material->unlit ? 0.f : 1.f);
    block.covered += at.count;
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
          float const share = options_.occlusion != Occlusion::colour ? 1
                              : own_share                             ? surface.colour[k][i]
                                                                      : surface.occlusion[i];
          surface.colour[k][i] = kGrey * share;
        }
    if (options_.occlusion != Occlusion::occlusion) surface.occlusion.fill(1);
  }

  /// Through a sample.
  Ray ray(int column, int row) const {
    return {lens_.eye, lens_.direction(float(column), float(row)), lens_.near, lens_.far};
  }

  /// Packets of rays, each for a square of pixels.
  void trace(Image& picture) const {
    int const side = int(std::sqrt(double(RayScene::kPacket))), n = options_.supersample, tile = side / n;
    std::size_t const rows = std::size_t((options_.size + tile - 1) / tile);
    parallel_for(rows, 8, [&](std::size_t row) {
      for (int left = 0, top = int(row) * tile; left < options_.size; left += tile) {
        std::array<Ray, RayScene::kPacket> rays;
        for (int i = 0; i < int(rays.size()); ++i) rays[i] = ray(left * n + i % side, top * n + i / side);
        auto const hits = model_.scene.first_hits(rays);
        for (int y = top; y < std::min(top + tile, options_.size); ++y)
          for (int x = left; x < std::min(left + tile, options_.size); ++x) {
            Shading const shading = shading_at(x, y, 1);
            std::array<int, 4> sums{};
            for (int i = 0; i < n * n; ++i) {
              std::size_t const ray = std::size_t(((y - top) * n + i / n) * side + (x - left) * n + i % n);
              Rays const sight{1, {float(n * x + i % n)}, {float(n * y + i / n)}};
              Texel const texel = hits[ray] ? layers(sight, rays[ray], *hits[ray], shading) : kNothing;
              for (std::size_t k = 0; k < 4; ++k) sums[k] += texel[k];
            }
            put(picture, x, y, sums);
          }
      }
    });
  }

  /// All samples of a square of pixels are seen along the line through its middle.
  Shading shading_at(int x, int y, int pixels) const {
    int const n = options_.supersample;
    float const middle = float(n * pixels - 1) / 2;
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
    V3f light = seen.facet.material->unlit ? base : shading(base, normal, surface.occlusion[0]);
    if (model_.surface.emissive()) light += lane(surface.emission, 0);
    return {{srgb_byte(light.x), srgb_byte(light.y), srgb_byte(light.z)}, surface.colour[3][0]};
  }

  SurveyedModel const& model_;
  PictureOptions options_;
  Lens lens_;
  V3f to_light_;
  int block_;  ///< pixels of a block's side
  std::array<Spot, kLanes> spots_{};
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
