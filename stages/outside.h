// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What can be seen of an original: what lies hidden within it would take triangles from what is looked at.

#include "stages/data.h"

#include <optional>

namespace vitrine {

/// The faces that are seen from somewhere on a sphere around a tangle: a model of three or more faces a vertex, whose
/// layers hang together within. On a surface simplification spends little on what is hidden, and to take that away
/// would tear it.
/// In:     an opaque model: through others more can be seen.
/// Out:    the same vertices, fewer faces in their old order. Nothing where there is no tangle, or most of it is seen.
/// Errors: those of bounding_sphere.
/// Cost:   64 views of 600 x 600 samples.
std::optional<SourceModel> outside(SourceModel const& model);

}  // namespace vitrine
