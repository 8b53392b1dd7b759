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

constexpr std::size_t kReach = 5, kWindow = 2 * kReach + 1;

std::array<double, kWindow> gaussian_window() {
  constexpr double sigma = 1.5;
  std::array<double, kWindow> weights;
  double sum = 0;
  for (std::size_t i = 0; i < kWindow; ++i) {
    double const x = double(i) - double(kReach);
    sum += weights[i] = std::exp(-x * x / (2 * sigma * sigma));
  }
  for (double& w : weights) w /= sum;
  return weights;
}

/// A square of numbers, row by row.
struct Plane {
  std::size_t side;
  std::vector<double> values;

  explicit Plane(std::size_t of) : side(of), values(of * of) {}
};

Plane luminance(Image const& image) {
  Plane plane(static_cast<std::size_t>(image.width));
  for (std::size_t i = 0; i < plane.values.size(); ++i) {
    std::uint8_t const* p = &image.texels[4 * i];
    plane.values[i] = (0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2]) / 255;
  }
  return plane;
}

Plane product(Plane const& a, Plane const& b) {
  Plane plane(a.side);
  std::transform(a.values.begin(), a.values.end(), b.values.begin(), plane.values.begin(), std::multiplies<>());
  return plane;
}

/// Weighted means over the windows that lie wholly inside.
Plane window_means(Plane const& plane) {
  static std::array<double, kWindow> const weights = gaussian_window();
  std::size_t const side = plane.side, inner = side - 2 * kReach;
  std::vector<double> rows(side * inner);
  for (std::size_t y = 0; y < side; ++y)
    for (std::size_t k = 0; k < kWindow; ++k)
      for (std::size_t x = 0; x < inner; ++x) rows[y * inner + x] += weights[k] * plane.values[y * side + x + k];
  Plane means(inner);
  for (std::size_t y = 0; y < inner; ++y)
    for (std::size_t k = 0; k < kWindow; ++k)
      for (std::size_t x = 0; x < inner; ++x) means.values[y * inner + x] += weights[k] * rows[(y + k) * inner + x];
  return means;
}

/// Structural similarity of each whole window.
Plane similarity(Plane const& a, Plane const& b) {
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  Plane const mean_a = window_means(a), mean_b = window_means(b);
  Plane const mean_aa = window_means(product(a, a)), mean_bb = window_means(product(b, b));
  Plane const mean_ab = window_means(product(a, b));
  Plane map(mean_a.side);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    double const ma = mean_a.values[i], mb = mean_b.values[i];
    double const squares = ma * ma + mb * mb;
    double const variances = mean_aa.values[i] + mean_bb.values[i] - squares;
    double const covariance = mean_ab.values[i] - ma * mb;
    map.values[i] = (2 * ma * mb + c1) * (2 * covariance + c2) / ((squares + c1) * (variances + c2));
  }
  return map;
}

double psnr(double mse) {
  constexpr double most = 100;  // of equal pictures, so that it stays a number
  return mse > 0 ? std::min(most, -10 * std::log10(mse)) : most;
}

/// Error and overlap, pixel by pixel; which pixels are foreground.
std::vector<bool> compare_pixels(Image const& a, Image const& b, Difference& result) {
  std::size_t const pixels = a.texels.size() / 4;
  std::vector<bool> foreground(pixels);
  std::uint64_t all = 0, inside = 0, covered = 0, smaller = 0, larger = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    std::uint8_t const *p = &a.texels[4 * i], *q = &b.texels[4 * i];
    std::uint64_t error = 0;
    for (int k = 0; k < 3; ++k) error += static_cast<std::uint64_t>((p[k] - q[k]) * (p[k] - q[k]));
    all += error;
    smaller += std::min(p[3], q[3]);
    larger += std::max(p[3], q[3]);
    foreground[i] = p[3] != 0 || q[3] != 0;
    if (foreground[i]) inside += error, ++covered;
  }
  constexpr double unit = 1e4 / (3.0 * 255 * 255);
  result.mse1e4 = unit * double(all) / double(pixels);
  result.foreground_mse1e4 = covered > 0 ? unit * double(inside) / double(covered) : 0;
  result.psnr = psnr(result.mse1e4 / 1e4);
  result.iou = larger > 0 ? double(smaller) / double(larger) : 1;
  return foreground;
}

void compare_structure(Image const& a, Image const& b, std::vector<bool> const& foreground, Difference& result) {
  Plane const map = similarity(luminance(a), luminance(b));
  std::size_t const side = static_cast<std::size_t>(a.width);
  double all = 0, inside = 0;
  std::size_t windows = 0;
  for (std::size_t y = 0, i = 0; y < map.side; ++y)
    for (std::size_t x = 0; x < map.side; ++x, ++i) {
      all += map.values[i];
      if (foreground[(y + kReach) * side + x + kReach]) inside += map.values[i], ++windows;
    }
  result.ssim = all / double(map.values.size());
  result.foreground_ssim = windows > 0 ? inside / double(windows) : 1;
}

std::string shape(Image const& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height) + " x " + std::to_string(image.channels);
}

void require_alike(Image const& a, Image const& b) {
  if (shape(a) != shape(b))
    throw Error(ErrorKind::invalid_input, "a picture of " + shape(a) + " is compared with one of " + shape(b),
                "draw both at the same size");
  if (a.width != a.height || a.channels != 4 || a.width < int(kWindow))
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
