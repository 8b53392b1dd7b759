// SPDX-License-Identifier: Apache-2.0
#include "stages/series.h"

#include "stages/error.h"
#include "stages/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace vitrine {
namespace {

using std::numbers::pi;

constexpr double kLowest = 10, kHighest = 80;

std::string shape(Image const& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height) + " x " + std::to_string(image.channels);
}

void require_alike(Image const& a, Image const& b) {
  if (a.width != b.width || a.height != b.height || a.channels < 3 || b.channels < 3)
    throw Error(ErrorKind::invalid_input, "a view of " + shape(a) + " is compared with a frame of " + shape(b),
                "make both at the same size, in colour");
}

/// Sum of squares over the pixels and R, G, B.
std::uint64_t squares(Image const& a, Image const& b) {
  require_alike(a, b);
  std::size_t const step_a = std::size_t(a.channels), step_b = std::size_t(b.channels), width = std::size_t(a.width);
  std::uint64_t sum = 0;
  for (std::size_t y = 0; y < std::size_t(a.height); ++y) {
    std::uint8_t const *p = &a.texels[y * width * step_a], *q = &b.texels[y * width * step_b];
    for (std::size_t x = 0; x < width; ++x, p += step_a, q += step_b) {
      int const red = p[0] - q[0], green = p[1] - q[1], blue = p[2] - q[2];
      sum += static_cast<std::uint32_t>(red * red + green * green + blue * blue);
    }
  }
  return sum;
}

}  // namespace

std::vector<double> row_elevations(int rows) {
  std::vector<double> elevations;
  for (int r = 0; r < rows; ++r)
    elevations.push_back(rows == 1 ? kLowest : kLowest + (kHighest - kLowest) * r / (rows - 1));
  return elevations;
}

std::vector<V3d> series_directions(int frames, int rows) {
  std::vector<V3d> all;
  for (double const elevation : row_elevations(rows)) {
    double const rise = elevation * pi / 180;
    for (int i = 0; i < frames; ++i) {
      double const turn = 2 * pi * i / frames;
      all.emplace_back(std::sin(turn) * std::cos(rise), std::sin(rise), std::cos(turn) * std::cos(rise));
    }
  }
  return all;
}

std::vector<Showing> nearest_frames(std::vector<V3d> const& views, std::vector<V3d> const& frames) {
  constexpr double tie = 1e-9;
  std::vector<Showing> showings;
  for (std::size_t v = 0; v < views.size(); ++v) {
    std::size_t nearest = 0;
    for (std::size_t f = 1; f < frames.size(); ++f)
      if (views[v].dot(frames[f]) > views[v].dot(frames[nearest]) + tie) nearest = f;
    showings.push_back({v, nearest});
  }
  return showings;
}

double mse1e4(std::vector<Image> const& views, std::vector<Image> const& frames, std::vector<Showing> const& showings) {
  if (showings.empty()) throw Error(ErrorKind::invalid_input, "no frame of the series is shown", "give it frames");
  std::vector<double> errors(showings.size());
  parallel_for(showings.size(), 1, [&](std::size_t i) {
    Image const& view = views[showings[i].view];
    double const pixels = double(view.width) * double(view.height);
    errors[i] = 1e4 * double(squares(view, frames[showings[i].frame])) / (3.0 * 255 * 255 * pixels);
  });
  double sum = 0;
  for (double const error : errors) sum += error;
  return sum / double(errors.size());
}

Image sprite_sheet(std::vector<Image> const& frames, int columns) {
  int const side = frames.front().width, lines = (int(frames.size()) + columns - 1) / columns;
  Image sheet{side * columns, side * lines, 3, ColourSpace::srgb, {}};
  std::size_t const row = 3 * std::size_t(side), line = 3 * std::size_t(sheet.width);
  sheet.texels.assign(line * std::size_t(sheet.height), 255);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    std::uint8_t* const corner =
        &sheet.texels[i / std::size_t(columns) * std::size_t(side) * line + i % std::size_t(columns) * row];
    for (std::size_t y = 0; y < std::size_t(side); ++y) std::copy_n(&frames[i].texels[y * row], row, corner + y * line);
  }
  return sheet;
}

}  // namespace vitrine
