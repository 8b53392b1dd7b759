// SPDX-License-Identifier: Apache-2.0
#include "stages/palette.h"

#include "stages/colour.h"
#include "stages/mip_map.h"
#include "stages/quantize.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

using Imath::V2i;

constexpr int kTexels = 8;  // a side

/// The plane of the colours: a rectangle of it, from `corner` on.
struct Plane {
  V3d corner{0, 0, 0}, along{1, 0, 0}, across{0, 1, 0};  ///< directions: unit, orthogonal
  double length = 0, width = 0;
  double off = 0;  ///< of the colours, see Palette::off
};

V3d axis(Eigen::Vector3d const& v) { return v.sum() < 0 ? V3d(-v[0], -v[1], -v[2]) : V3d(v[0], v[1], v[2]); }

Plane plane_of(std::span<V3f const> colours) {
  V3d mean(0);
  for (V3f const& c : colours) mean += V3d(c) / double(colours.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (V3f const& c : colours) {
    Eigen::Vector3d const d(c.x - mean.x, c.y - mean.y, c.z - mean.z);
    spread += d * d.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> const solver(spread);
  Plane plane{mean, axis(solver.eigenvectors().col(2)), axis(solver.eigenvectors().col(1))};
  Imath::Box<Imath::V2d> box;
  for (V3f const& c : colours) box.extendBy({(V3d(c) - mean).dot(plane.along), (V3d(c) - mean).dot(plane.across)});
  plane.corner = mean + plane.along * box.min.x + plane.across * box.min.y;
  plane.length = box.max.x - box.min.x;
  plane.width = box.max.y - box.min.y;
  plane.off = std::sqrt(std::max(0.0, solver.eigenvalues()[0]) / (3 * double(colours.size())));
  return plane;
}

/// Where the plane lies in the unit square: evenly in both directions, from the first to the last code that lies in the
/// picture's inner part, where clients do not read across its edge.
struct Layout {
  int last, margin;
  double per_code;  ///< how far one code leads in the plane

  Layout(Plane const& plane, int bits) : last((1 << bits) - 1), margin((last + 2 * kTexels - 1) / (2 * kTexels)) {
    per_code = std::max({plane.length, plane.width, 1e-6}) / (last - 2 * margin);
  }
  V2i nearest(Plane const& plane, V3f const& colour) const {
    V3d const from = V3d(colour) - plane.corner;
    return inside(V2i(int(std::lround(from.dot(plane.along) / per_code)) + margin,
                      int(std::lround(from.dot(plane.across) / per_code)) + margin));
  }
  V2i inside(V2i const& code) const {
    return {std::clamp(code.x, margin, last - margin), std::clamp(code.y, margin, last - margin)};
  }
  V2f uv(V2i const& code) const {
    AxisCodes const codes(0, 1, int(std::lround(std::log2(last + 1))));
    return {codes.value(code.x), codes.value(code.y)};
  }
};

Image picture(Plane const& plane, Layout const& layout) {
  Image image{kTexels, kTexels, 3, ColourSpace::srgb, {}};
  auto const place = [&](int texel) {
    return ((texel + 0.5) / kTexels * layout.last - layout.margin) * layout.per_code;
  };
  for (int y = 0; y < kTexels; ++y)
    for (int x = 0; x < kTexels; ++x) {
      double const s = std::clamp(place(x), 0.0, plane.length), t = std::clamp(place(y), 0.0, plane.width);
      V3d const colour = plane.corner + plane.along * s + plane.across * t;
      for (unsigned k = 0; k < 3; ++k) image.texels.push_back(to_byte(float(colour[k])));
    }
  return image;
}

/// What a client shows of the picture.
class Shown {
 public:
  explicit Shown(Image const& image) : map_(image, ColourSpace::srgb) {}

  V3f operator()(V2f const& uv) const {
    Rgba const c = map_.sample(uv, 0, {});
    return {linear_to_srgb(c[0]), linear_to_srgb(c[1]), linear_to_srgb(c[2])};
  }

 private:
  MipMap map_;
};

}  // namespace

Palette make_palette(std::span<V3f const> colours, int bits) {
  Plane const plane = plane_of(colours);
  Layout const layout(plane, bits);
  Palette palette{picture(plane, layout), plane.off, {}};
  Shown const shown(palette.image);
  int const side = layout.last + 1;
  std::vector<V3f> decoded(std::size_t(side) * side, V3f(-1));  // by code, as they are asked for
  auto const distance = [&](V2i const& code, V3f const& colour) {
    V3f& found = decoded[std::size_t(code.y) * side + code.x];
    if (found.x < 0) found = shown(layout.uv(code));
    return (found - colour).length2();
  };
  palette.uvs.reserve(colours.size());
  for (V3f const& colour : colours) {
    V2i code = layout.nearest(plane, colour);
    for (bool moved = true; moved;) {
      moved = false;
      for (V2i const& step : {V2i(-1, 0), V2i(1, 0), V2i(0, -1), V2i(0, 1)}) {
        V2i const other = layout.inside(code + step);
        if (distance(other, colour) >= distance(code, colour)) continue;
        code = other;
        moved = true;
      }
    }
    palette.uvs.push_back(layout.uv(code));
  }
  return palette;
}

}  // namespace vitrine
