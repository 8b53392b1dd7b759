// SPDX-License-Identifier: Apache-2.0
#include "stages/compare.h"

#include "stages/error.h"
#include "stages/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace vitrine {
namespace {

constexpr int kReach = 5, kWindow = 2 * kReach + 1;

/// Weights of the middle of a window, and of its neighbours on either side.
std::array<float, kReach + 1> gaussian_window() {
  constexpr double sigma = 1.5;
  std::array<double, kReach + 1> weights;
  double sum = 0;
  for (int i = 0; i <= kReach; ++i) sum += (i > 0 ? 2 : 1) * (weights[i] = std::exp(-i * i / (2 * sigma * sigma)));
  std::array<float, kReach + 1> scaled{1};
  for (int i = 1; i <= kReach; ++i) scaled[0] -= 2 * (scaled[i] = float(weights[i] / sum));
  return scaled;
}

std::array<float, kReach + 1> const kWeights = gaussian_window();

/// Weighted means of `count` windows along rows (stride 1) or across them; `from`: the middle of the first.
void window_means(float const* from, std::ptrdiff_t stride, int count, float* means) {
  std::array<float, kReach + 1> const w = kWeights;
  for (int x = 0; x < count; ++x, ++from) {
    float mean = w[0] * from[0];
    for (int k = 1; k <= kReach; ++k) mean += w[k] * (from[-k * stride] + from[k * stride]);
    means[x] = mean;
  }
}

/// A rectangle of numbers, row by row.
struct Plane {
  int width, height;
  std::vector<float> values;

  Plane(int w, int h) : width(w), height(h), values(std::size_t(w) * std::size_t(h)) {}
  float* row(int y) { return values.data() + std::ptrdiff_t(y) * width; }
  float const* row(int y) const { return values.data() + std::ptrdiff_t(y) * width; }
};

/// Over all windows that lie wholly inside.
Plane window_means(Plane const& plane) {
  Plane along(plane.width - 2 * kReach, plane.height), means(along.width, plane.height - 2 * kReach);
  for (int y = 0; y < along.height; ++y) window_means(plane.row(y) + kReach, 1, along.width, along.row(y));
  for (int y = 0; y < means.height; ++y) window_means(along.row(y + kReach), along.width, means.width, means.row(y));
  return means;
}

/// Columns and rows from the first to before the end.
struct Rectangle {
  int left, top, right, bottom;

  bool empty() const { return left >= right; }
};

/// What windows need of two luminances a and b, less one half: floats keep more of what varies.
struct Moments {
  Plane a, b, squares, product;

  Moments(Image const& p, Image const& q, Rectangle const& part)
      : a(part.right - part.left, part.bottom - part.top), b(a), squares(a), product(a) {
    for (int y = 0; y < a.height; ++y) {
      std::size_t const first = std::size_t(part.top + y) * std::size_t(p.width) + std::size_t(part.left);
      luminances(&p.texels[4 * first], a.width, a.row(y));
      luminances(&q.texels[4 * first], b.width, b.row(y));
    }
    for (std::size_t i = 0; i < a.values.size(); ++i) {
      squares.values[i] = a.values[i] * a.values[i] + b.values[i] * b.values[i];
      product.values[i] = a.values[i] * b.values[i];
    }
  }

  static void luminances(std::uint8_t const* texel, int count, float* values) {
    for (int x = 0; x < count; ++x, texel += 4)
      values[x] = float(299 * texel[0] + 587 * texel[1] + 114 * texel[2] - 127500) / 255000;
  }
};

/// Structural similarity of each whole window of a part.
Plane similarity(Image const& p, Image const& q, Rectangle const& part) {
  constexpr float c1 = 0.01f * 0.01f, c2 = 0.03f * 0.03f;
  Moments const moments(p, q, part);
  Plane const mean_a = window_means(moments.a), mean_b = window_means(moments.b);
  Plane const mean_squares = window_means(moments.squares), mean_product = window_means(moments.product);
  Plane map(mean_a.width, mean_a.height);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    float const ma = mean_a.values[i], mb = mean_b.values[i];
    float const variances = mean_squares.values[i] - (ma * ma + mb * mb);
    float const covariance = mean_product.values[i] - ma * mb;
    float const la = ma + 0.5f, lb = mb + 0.5f;
    map.values[i] = (2 * la * lb + c1) * (2 * covariance + c2) / ((la * la + lb * lb + c1) * (variances + c2));
  }
  return map;
}

double psnr(double mse) {
  constexpr double most = 100;  // of equal pictures, so that it stays a number
  return mse > 0 ? std::min(most, -10 * std::log10(mse)) : most;
}

/// Whether the object covers any of a pixel in either picture.
using Foreground = std::vector<std::uint8_t>;

/// Error and overlap, pixel by pixel.
Foreground compare_pixels(Image const& a, Image const& b, Difference& result) {
  std::size_t const pixels = a.texels.size() / 4;
  Foreground foreground(pixels);
  std::uint64_t all = 0, inside = 0, covered = 0, smaller = 0, larger = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    std::uint8_t const *p = &a.texels[4 * i], *q = &b.texels[4 * i];
    int error = 0;
    for (int k = 0; k < 3; ++k) error += (p[k] - q[k]) * (p[k] - q[k]);
    all += static_cast<std::uint64_t>(error);
    smaller += std::min(p[3], q[3]);
    larger += std::max(p[3], q[3]);
    foreground[i] = (p[3] | q[3]) != 0;
    if (foreground[i]) inside += static_cast<std::uint64_t>(error), ++covered;
  }
  constexpr double unit = 1e4 / (3.0 * 255 * 255);
  result.mse1e4 = unit * double(all) / double(pixels);
  result.foreground_mse1e4 = covered > 0 ? unit * double(inside) / double(covered) : 0;
  result.psnr = psnr(result.mse1e4 / 1e4);
  result.iou = larger > 0 ? double(smaller) / double(larger) : 1;
  return foreground;
}

/// The part that holds all windows with a difference in them: elsewhere the similarity is 1.
Rectangle differing(Image const& a, Image const& b) {
  int const side = a.width, row_bytes = 4 * side;
  Rectangle found{side, side, 0, 0};
  for (int y = 0; y < side; ++y) {
    std::uint8_t const *p = &a.texels[std::size_t(y) * row_bytes], *q = &b.texels[std::size_t(y) * row_bytes];
    auto const [first, other] = std::mismatch(p, p + row_bytes, q);
    if (first == p + row_bytes) continue;
    int last = row_bytes - 1;
    while (p[last] == q[last]) --last;
    found.left = std::min(found.left, int(first - p) / 4), found.right = std::max(found.right, last / 4 + 1);
    found.top = std::min(found.top, y), found.bottom = y + 1;
  }
  if (found.empty()) return found;
  constexpr int grown = 2 * kReach;  // a window's middle may lie its reach away, and it reaches as far beyond
  return {std::max(found.left - grown, 0), std::max(found.top - grown, 0), std::min(found.right + grown, side),
          std::min(found.bottom + grown, side)};
}

void compare_structure(Image const& a, Image const& b, Foreground const& foreground, Difference& result) {
  int const side = a.width, windows = side - 2 * kReach;
  std::size_t inside = 0;
  for (int y = kReach; y < side - kReach; ++y)
    for (int x = kReach; x < side - kReach; ++x)
      inside += foreground[std::size_t(y) * std::size_t(side) + std::size_t(x)];
  double lost = 0, lost_inside = 0;
  Rectangle const part = differing(a, b);
  if (!part.empty()) {
    Plane const map = similarity(a, b, part);
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x) {
        double const loss = 1 - double(map.row(y)[x]);
        std::size_t const middle =
            std::size_t(part.top + kReach + y) * std::size_t(side) + std::size_t(part.left + kReach + x);
        lost += loss;
        lost_inside += foreground[middle] ? loss : 0;
      }
  }
  result.ssim = 1 - lost / (double(windows) * double(windows));
  result.foreground_ssim = inside > 0 ? 1 - lost_inside / double(inside) : 1;
}

std::string shape(Image const& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height) + " x " + std::to_string(image.channels);
}

void require_alike(Image const& a, Image const& b) {
  if (shape(a) != shape(b))
    throw Error(ErrorKind::invalid_input, "a picture of " + shape(a) + " is compared with one of " + shape(b),
                "draw both at the same size");
  if (a.width != a.height || a.channels != 4 || a.width < kWindow)
    throw Error(ErrorKind::invalid_input,
                "a picture of " + shape(a) + " is compared, not a square of 11 x 11 x 4 or more",
                "draw at a larger size");
}

constexpr double Difference::*kFigures[] = {&Difference::mse1e4, &Difference::foreground_mse1e4, &Difference::psnr,
                                            &Difference::ssim,   &Difference::foreground_ssim,   &Difference::iou};

}  // namespace

Difference compare(Image const& a, Image const& b) {
  require_alike(a, b);
  Difference result;
  compare_structure(a, b, compare_pixels(a, b, result), result);
  return result;
}

Comparison compare(std::vector<Image> const& a, std::vector<Image> const& b) {
  if (a.size() != b.size() || a.empty())
    throw Error(ErrorKind::invalid_input,
                std::to_string(a.size()) + " views are compared with " + std::to_string(b.size()),
                "draw both from the same cameras");
  Comparison result;
  result.views.resize(a.size());
  parallel_for(a.size(), 1, [&](std::size_t i) { result.views[i] = compare(a[i], b[i]); });
  for (double Difference::*figure : kFigures) {
    for (Difference const& view : result.views) result.mean.*figure += view.*figure;
    result.mean.*figure /= double(a.size());
  }
  result.psnr_of_mean_mse = psnr(result.mean.mse1e4 / 1e4);
  auto const worst = std::max_element(result.views.begin(), result.views.end(),
                                      [](auto const& p, auto const& q) { return p.mse1e4 < q.mse1e4; });
  result.worst = static_cast<std::size_t>(worst - result.views.begin());
  return result;
}

}  // namespace vitrine
