// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Meshes small enough to draw, and a few larger ones with known properties.

#include "stages/data.h"

namespace vitrine::test {

TriMesh triangle();
TriMesh tetrahedron();
TriMesh cube(V3f centre = {0, 0, 0}, float edge = 1);  ///< closed, 8 vertices, 12 faces
TriMesh open_cone(int sides = 16);                     ///< a disk with an apex
TriMesh grid(int columns, int rows);                   ///< flat disk in the xz plane, facing +Y, unit squares
TriMesh sphere(int slices = 32, int stacks = 16);      ///< closed, genus 0, radius 1
TriMesh torus(int major = 32, int minor = 16, float radius = 1, float tube = 0.4f);  ///< closed, genus 1
TriMesh pierced_slab(int holes);  ///< closed, a grid of holes x holes square holes: genus holes^2
TriMesh moebius(int steps = 32);  ///< one boundary, not orientable: its last edge joins two faces of opposite winding
TriMesh sliver();                 ///< one triangle of height 1e-6
TriMesh non_manifold_edge();      ///< three faces on one edge
TriMesh two_shells();             ///< two cubes, apart
TriMesh bumpy_sphere(int slices, int stacks, unsigned seed = 1);  ///< a sphere with smooth seeded relief

/// An uncoloured model of this mesh.
SourceModel plain_model(TriMesh mesh);
/// The same with a smooth colour per vertex, a function of its position.
SourceModel painted_model(TriMesh mesh);

}  // namespace vitrine::test
