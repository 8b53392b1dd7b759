// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The decimation of the paper, which simplify() offers beside its own.

#include "stages/simplify.h"

namespace vitrine {

/// OpenMesh's half-edge collapse on a copy of the mesh that is cut where it is not manifold, and welded again at the
/// end.
/// Source: Limper et al. 2013, section 3.1. In, out and errors as simplify(), with OpenMesh's limits: boundaries and
///         cuts
/// are not held and recede, no part vanishes, and options.max_error may be exceeded by a few per cent.
SimplifiedMesh simplify_openmesh(TriMesh const& mesh, SimplifyOptions const& options);

}  // namespace vitrine
