// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A triangle mesh whose edges collapse: any mesh, manifold or not. 24 bytes a vertex and 24 a face.

#include "stages/data.h"

#include <cstdint>
#include <vector>

namespace vitrine {

class CollapseMesh {
 public:
  using Index = std::uint32_t;
  static constexpr Index kNone = ~Index{0};

  explicit CollapseMesh(TriMesh const& mesh);

  std::size_t vertices() const { return vertices_.size(); }
  std::size_t faces() const { return alive_; }

  /// Positions are read in the unit box around the centre, where products of doubles keep their digits, and written
  /// as the float in model units that the output stores: what is checked is what is returned.
  V3d position(Index v) const { return to_unit(vertices_[v].position); }
  V3f to_model(V3d const& unit) const { return V3f(unit / scale_ + centre_); }
  V3d to_unit(V3f const& model) const { return (V3d(model) - centre_) * scale_; }
  double diagonal() const { return diagonal_; }  ///< of the bounding box, in unit coordinates

  Triangle const& face(Index f) const { return faces_[f].corners; }
  bool is_alive(Index f) const { return faces_[f].corners[0] != kNone; }

  /// Calls visit(f) for each face around v, in an order that depends on the collapses so far alone.
  template <class Visit>
  void for_faces(Index v, Visit const& visit) {
    for (Index* link = &vertices_[v].first; *link != kNone;) {
      Index const corner = *link, f = corner / 3;
      if (is_alive(f)) {
        visit(f);
        link = &next(corner);
      } else {
        *link = next(corner);  // a face that went since the last visit
      }
    }
  }

  /// A vertex that shares faces with another one.
  struct Neighbour {
    Index vertex, faces;
    Index faces_of_other = 0;  ///< set by junction(): of the other vertex
    bool opposite = false;     ///< set by junction(): in a face with both
    bool is_tangled() const { return faces > 2 || faces_of_other > 2; }
  };
  std::vector<Neighbour> const& neighbours(Index v);  ///< valid until the next call

  /// What making a and b one vertex would do to the surface around them.
  struct Junction {
    /// The link condition of Dey et al. 1999, "Topology Preserving Edge Contraction", holds wherever the surface is
    /// manifold, and no two boundaries meet. A hole of three edges may close; a lone face or tetrahedron may vanish.
    bool keeps_topology = false;
    bool closes = false;    ///< faces would fall onto one another
    bool vanishes = false;  ///< nothing would be left of them
    std::size_t going = 0;  ///< faces that would go; none: a and b share no face
  };
  Junction junction(Index a, Index b);

  /// Whether each face that stays keeps its side, the cosine between its normals being at least `least_cosine`, and
  /// becomes no needle: its height over its longest edge stays above `least_roundness`, or above half of what it was.
  bool keeps_shape(Index a, Index b, V3f const& target, double least_cosine, double least_roundness);

  /// Makes a and b one vertex, a, at `target`. Faces on the edge go.
  void collapse(Index a, Index b, V3f const& target);

  /// Keeps one of the faces around v that have the same corners, in either winding.
  void remove_duplicates(Index v);

  void remove_around(Index v);

  /// From now on each face that goes is added to `faces`.
  void note_removed(std::vector<Index>* faces) { removed_ = faces; }

  double twice_area_around(Index a, Index b);

  /// The mesh as it is now: faces in their old order; vertices that are in use.
  TriMesh extract() const;
  std::vector<Index> alive_faces() const;    ///< in order; extract() numbers them so
  std::vector<Index> used_vertices() const;  ///< likewise

 private:
  struct Vertex {
    V3f position;
    Index first;        ///< corner (3 f + k) that begins the list of its corners, kNone at the end
    Index slot = 0;     ///< where in neighbours_ it is, if it is there
    bool open = false;  ///< on a boundary
  };
  struct Face {
    Triangle corners;           ///< the first is kNone once the face has gone
    std::array<Index, 3> next;  ///< per corner: the next one of its vertex
  };

  Index& next(Index corner) { return faces_[corner / 3].next[corner % 3]; }
  bool has(Index f, Index v) const;
  std::array<Index, 2> others(Index f, Index v) const;  ///< the other corners of f, in its winding
  Neighbour* neighbour(Index v);                        ///< of the last call of neighbours(), or null
  void remove(Index f);

  std::vector<Vertex> vertices_;
  std::vector<Face> faces_;
  std::vector<Neighbour> neighbours_;
  std::vector<Index>* removed_ = nullptr;
  std::size_t alive_ = 0;
  V3d centre_{0, 0, 0};
  double scale_ = 1, diagonal_ = 0;
};

}  // namespace vitrine
