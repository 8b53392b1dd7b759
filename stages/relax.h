// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Brings down the stretch of a map of a disk, or spreads it as is wanted.

#include "stages/data.h"

#include <vector>

namespace vitrine {

/// As rigid as possible: each face is turned, never stretched, as far as its neighbours allow.
/// In:     a disk that is no dot, a map of it, and for each face the length in the plane that a length on it is to
///         have.
/// Out:    the map after ten rounds, its area the sum of the faces' own by these lengths. It may fold, or cross itself,
///         where the given one was far from it: judge it again. Empty if the system cannot be factorised.
/// Source: Liu et al. 2008, "A Local/Global Approach to Mesh Parameterization", section 4; the lengths are ours.
/// Cost:   one sparse factorisation, ten solves.
std::vector<V2f> relax(TriMesh const& disk, std::vector<V2f> const& uvs, std::vector<float> const& lengths);

}  // namespace vitrine
