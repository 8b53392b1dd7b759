// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What can be seen of an original: what lies hidden within it would take triangles from what is looked at.

#include "stages/data.h"

#include <optional>

namespace vitrine {

/// The faces that are seen from somewhere on a sphere around the model, where much may lie within: in a tangle, of three
/// or more faces a vertex, whose layers hang together; and in an assembly, no shell of which has most of the faces, as
/// an engine in its housing. There the neighbours of what is seen are kept, too, as small faces fall between samples. On
/// one surface simplification spends little on what is hidden, and to take that away would tear it.
/// In:     an opaque model: through others more can be seen.
/// Out:    the same vertices, fewer faces in their old order. Nothing where there is neither, or most of it is seen.
/// Errors: those of bounding_sphere.
/// Cost:   64 views of 600 x 600 samples, for tangles and assemblies alone.
std::optional<SourceModel> outside(SourceModel const& model);

}  // namespace vitrine
