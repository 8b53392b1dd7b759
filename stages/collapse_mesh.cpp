// SPDX-License-Identifier: Apache-2.0
#include "stages/collapse_mesh.h"

#include <algorithm>

namespace vitrine {

CollapseMesh::CollapseMesh(TriMesh const& mesh) : alive_(mesh.triangles.size()) {
  Box3f const box = bounds(mesh);
  V3d const size = V3d(box.max) - V3d(box.min);
  double const longest = std::max({size.x, size.y, size.z});
  centre_ = (V3d(box.min) + V3d(box.max)) / 2;
  scale_ = longest > 0 ? 1 / longest : 1;
  diagonal_ = size.length() * scale_;
  vertices_.reserve(mesh.positions.size());
  for (V3f const& p : mesh.positions) vertices_.push_back({p, kNone});
  faces_.reserve(mesh.triangles.size());
  for (Triangle const& t : mesh.triangles) faces_.push_back({t, {}});
  for (std::size_t c = 3 * faces_.size(); c-- > 0;) {
    Index& first = vertices_[faces_[c / 3].corners[c % 3]].first;
    next(static_cast<Index>(c)) = first;
    first = static_cast<Index>(c);
  }
  for (Index v = 0; v < vertices(); ++v)
    for (Neighbour const& n : neighbours(v))
      if (n.faces == 1) vertices_[v].open = true;
}

bool CollapseMesh::has(Index f, Index v) const {
  Triangle const& t = faces_[f].corners;
  return t[0] == v || t[1] == v || t[2] == v;
}

std::array<CollapseMesh::Index, 2> CollapseMesh::others(Index f, Index v) const {
  Triangle const& t = faces_[f].corners;
  if (t[0] == v) return {t[1], t[2]};
  if (t[1] == v) return {t[2], t[0]};
  return {t[0], t[1]};
}

CollapseMesh::Neighbour* CollapseMesh::neighbour(Index v) {
  Index const slot = vertices_[v].slot;
  return slot < neighbours_.size() && neighbours_[slot].vertex == v ? &neighbours_[slot] : nullptr;
}

std::vector<CollapseMesh::Neighbour> const& CollapseMesh::neighbours(Index v) {
  neighbours_.clear();
  for_faces(v, [&](Index f) {
    for (Index w : others(f, v)) {
      if (Neighbour* known = neighbour(w)) {
        ++known->faces;
      } else {
        vertices_[w].slot = static_cast<Index>(neighbours_.size());
        neighbours_.push_back({w, 1});
      }
    }
  });
  return neighbours_;
}

CollapseMesh::Junction CollapseMesh::junction(Index a, Index b) {
  neighbours(a);
  if (!neighbour(b)) return {};  // their faces went when others fell onto one another
  std::size_t const shared = neighbour(b)->faces;
  std::size_t faces_of_a = 0, faces_of_b = 0, closing = 0;
  for_faces(b, [&](Index f) {
    ++faces_of_b;
    for (Index w : others(f, b))
      if (Neighbour* n = neighbour(w)) {
        ++n->faces_of_other;
        n->opposite = n->opposite || has(f, a);
      }
  });
  bool keeps = std::all_of(neighbours_.begin(), neighbours_.end(), [](Neighbour const& n) {
    bool const across_hole = n.faces == 1 && n.faces_of_other == 1;
    return n.opposite || n.faces_of_other == 0 || across_hole || n.is_tangled();
  });
  keeps = keeps && !(vertices_[a].open && vertices_[b].open && shared > 1);

  for_faces(a, [&](Index f) {
    ++faces_of_a;
    auto const [c, d] = others(f, a);
    if (c == b || d == b || !neighbour(c)->faces_of_other || !neighbour(d)->faces_of_other) return;
    bool const tangled = neighbour(c)->is_tangled() || neighbour(d)->is_tangled();
    for_faces(b, [&, c = c, d = d](Index g) {
      if (!has(g, c) || !has(g, d)) return;
      keeps = keeps && tangled;
      ++closing;
    });
  });
  bool const vanishes = faces_of_a + faces_of_b == 2 * (shared + closing);  // a lone face or a tetrahedron
  return {keeps || vanishes, closing > 0, vanishes, shared + (vanishes ? 2 : 1) * closing};
}

bool CollapseMesh::keeps_shape(Index a, Index b, V3f const& target, double least_cosine, double least_roundness) {
  V3d const to = to_unit(target);
  bool keeps = true;
  auto check = [&](Index from, Index f) {
    auto const [q, r] = others(f, from);
    if (!keeps || q == a || q == b || r == a || r == b) return;
    V3d const p = position(from), edge = position(r) - position(q);
    V3d const before = edge.cross(p - position(q)), after = edge.cross(to - position(q));
    double const before2 = before.length2(), after2 = after.length2(), dot = before.dot(after);
    auto longest2 = [&, q = q, r = r](V3d const& corner) {
      return std::max({edge.length2(), (corner - position(q)).length2(), (corner - position(r)).length2()});
    };
    double const was = longest2(p), is = longest2(to);
    bool const turned = before2 > 0 && (dot <= 0 || dot * dot < least_cosine * least_cosine * before2 * after2);
    bool const needle =
        after2 < least_roundness * least_roundness * is * is && 4 * after2 * was * was < before2 * is * is;
    keeps = after2 > 0 && !turned && !needle;
  };
  for_faces(a, [&](Index f) { check(a, f); });
  if (keeps) for_faces(b, [&](Index f) { check(b, f); });
  return keeps;
}

void CollapseMesh::remove(Index f) {
  faces_[f].corners[0] = kNone;
  --alive_;
  if (removed_) removed_->push_back(f);
}

void CollapseMesh::collapse(Index a, Index b, V3f const& target) {
  vertices_[a].position = target;
  vertices_[a].open = vertices_[a].open || vertices_[b].open;
  Index* link = &vertices_[b].first;
  for (; *link != kNone; link = &next(*link)) {
    Index const f = *link / 3;
    if (!is_alive(f)) continue;
    if (has(f, a)) {
      remove(f);
    } else {
      faces_[f].corners[*link % 3] = a;
    }
  }
  *link = vertices_[a].first;
  vertices_[a].first = vertices_[b].first;
  vertices_[b].first = kNone;
}

void CollapseMesh::remove_duplicates(Index v) {
  std::vector<std::array<Index, 3>> faces;  // the other corners, lower first, and the face
  for_faces(v, [&](Index f) {
    auto const [q, r] = others(f, v);
    faces.push_back({std::min(q, r), std::max(q, r), f});
  });
  std::sort(faces.begin(), faces.end());
  for (std::size_t i = 1; i < faces.size(); ++i)
    if (faces[i][0] == faces[i - 1][0] && faces[i][1] == faces[i - 1][1]) remove(faces[i][2]);
}

void CollapseMesh::remove_around(Index v) {
  for_faces(v, [&](Index f) { remove(f); });
}

double CollapseMesh::twice_area_around(Index a, Index b) {
  double sum = 0;
  auto add = [&](Index f) {
    Triangle const& t = face(f);
    sum += (position(t[1]) - position(t[0])).cross(position(t[2]) - position(t[0])).length();
  };
  for_faces(a, add);
  for_faces(b, [&](Index f) {
    if (!has(f, a)) add(f);
  });
  return sum;
}

std::vector<CollapseMesh::Index> CollapseMesh::alive_faces() const {
  std::vector<Index> alive;
  alive.reserve(alive_);
  for (Index f = 0; f < faces_.size(); ++f)
    if (is_alive(f)) alive.push_back(f);
  return alive;
}

std::vector<CollapseMesh::Index> CollapseMesh::used_vertices() const {
  std::vector<bool> used(vertices(), false);
  for (Index f : alive_faces())
    for (Index v : face(f)) used[v] = true;
  std::vector<Index> in_use;
  for (Index v = 0; v < vertices(); ++v)
    if (used[v]) in_use.push_back(v);
  return in_use;
}

TriMesh CollapseMesh::extract() const {
  TriMesh mesh;
  std::vector<Index> renamed(vertices(), kNone);
  for (Index v : used_vertices()) {
    renamed[v] = static_cast<Index>(mesh.positions.size());
    mesh.positions.push_back(vertices_[v].position);
  }
  for (Index f : alive_faces())
    mesh.triangles.push_back({renamed[face(f)[0]], renamed[face(f)[1]], renamed[face(f)[2]]});
  return mesh;
}

}  // namespace vitrine
