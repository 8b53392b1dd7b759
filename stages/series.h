// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The rival of a 3D thumbnail: a series of pictures that a viewer shows by turns.
/// Source: Limper et al. 2015, "Evaluating 3D Thumbnails for Virtual Object Galleries", section 4 (one axis, JPEG of
///         quality 90); 3D navigable pictures have a second axis.

#include "stages/view.h"

#include <cstddef>
#include <vector>

namespace vitrine {

/// Degrees above the horizon, the lowest row first: 10, as the turntable of the measure has it; more rows are spread
/// evenly from 10 to 80.
std::vector<double> row_elevations(int rows);

/// Unit vectors from the object to the camera, row by row. In a row the camera goes about +Y in equal steps, from +Z
/// towards +X. With one row and any divisor of 32 these are every so many of the turntable's 32 directions.
std::vector<V3d> series_directions(int frames, int rows);

/// What a viewer shows (`frame`) to whoever would see the object from `view`: indices into pictures.
struct Showing {
  std::size_t view, frame;
};

/// For each view the frame whose direction is nearest; of two at the same angle the first.
std::vector<Showing> nearest_frames(std::vector<V3d> const& views, std::vector<V3d> const& frames);

/// Mean square error of R, G, B as sRGB values in [0, 1], times 10^4, over the pixels of all showings: how far the
/// decoded frames are from the true views. Turning included where a frame stands in for other views than its own.
/// In:     `views` RGB or RGBA drawn on white, `frames` likewise, all of one size; at least one showing.
/// Errors: InvalidInput if sizes differ or nothing is shown.
double mse1e4(std::vector<Image> const& views, std::vector<Image> const& frames, std::vector<Showing> const& showings);

/// All frames in one image, line by line, `columns` to a line, edge to edge; what is left over is white.
/// In:     at least one frame; all RGB, squares of one size.
Image sprite_sheet(std::vector<Image> const& frames, int columns);

}  // namespace vitrine
