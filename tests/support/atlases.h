// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Small atlases laid out by hand.

#include "stages/data.h"

namespace vitrine::test {

/// Every face its own chart, a right triangle in its own square cell, whatever the face's shape: skewed frames.
/// Every third is mirrored.
Atlas scattered_atlas(TriMesh mesh, int size, int gutter = 2);

/// One chart, looked at along -Z: x in [0,1] to u, y in [0,1] to 1 - v, inside a margin of one texel.
Atlas facing_atlas(TriMesh mesh, int size);

}  // namespace vitrine::test
