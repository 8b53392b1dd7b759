// SPDX-License-Identifier: Apache-2.0
#include "stages/parameterize.h"

#include "stages/chart_topology.h"
#include "stages/error.h"
#include "stages/flatten.h"
#include "stages/parallel.h"

#include <algorithm>
#include <queue>
#include <utility>

namespace vitrine {
namespace {

constexpr double kMaxStretch = 1.8;      ///< beyond, texels starve
constexpr double kMaxAreaSpread = 16.0;  ///< between the scales of areas within a chart

/// Part of a chart that lies flat.
struct FlatPart {
  std::vector<std::uint32_t> faces;
  std::vector<CornerUvs> corner_uvs;  ///< of those faces
  double stretch = 1;
};

struct FlatChart {
  std::vector<FlatPart> parts;
  std::uint32_t retries = 0;
};

bool acceptable(FlatDisk const& flat) {
  return !flat.folded && !flat.overlapping && flat.stretch <= kMaxStretch && flat.area_spread <= kMaxAreaSpread;
}

/// Steps over edges from `start` to each face.
std::vector<double> steps_from(FaceAdjacency const& adjacency, std::uint32_t start) {
  std::vector<double> steps(adjacency.across.size(), -1);
  std::queue<std::uint32_t> front;
  steps[start] = 0;
  for (front.push(start); !front.empty(); front.pop())
    for (std::uint32_t neighbour : adjacency.across[front.front()])
      if (neighbour != kNone && steps[neighbour] < 0) {
        steps[neighbour] = steps[front.front()] + 1;
        front.push(neighbour);
      }
  return steps;
}

/// Cuts a disk of at least two faces into disks grown from two faces far apart.
std::vector<std::vector<std::uint32_t>> split(TriMesh const& disk) {
  FaceAdjacency const adjacency = face_adjacency(disk);
  auto const farthest = [](std::vector<double> const& steps) {
    return std::uint32_t(std::ranges::max_element(steps) - steps.begin());
  };
  std::uint32_t const one_end = farthest(steps_from(adjacency, 0));
  std::vector<double> priority = steps_from(adjacency, one_end);
  std::uint32_t const other_end = farthest(priority);
  std::vector<double> const from_other = steps_from(adjacency, other_end);
  for (std::size_t f = 0; f < priority.size(); ++f) priority[f] = -std::min(priority[f], from_other[f]);
  std::vector<std::uint32_t> face_charts;
  std::uint32_t const charts = grow_disks(disk, adjacency, std::array{one_end, other_end}, priority, face_charts);
  return faces_of_charts(face_charts, charts);
}

/// Flattens these faces, in parts where they do not lie flat as one.
void flatten_parts(TriMesh const& mesh, std::vector<std::uint32_t> faces, FlatChart& chart) {
  TriMesh const disk = submesh(mesh, faces);
  FlatDisk const flat = flatten(disk);
  if (faces.size() > 1 && !acceptable(flat)) {
    ++chart.retries;
    for (std::vector<std::uint32_t>& part : split(disk)) {
      for (std::uint32_t& f : part) f = faces[f];
      flatten_parts(mesh, std::move(part), chart);
    }
    return;
  }
  FlatPart& part = chart.parts.emplace_back();
  for (auto const& [a, b, c] : disk.triangles) part.corner_uvs.push_back({flat.uvs[a], flat.uvs[b], flat.uvs[c]});
  part.faces = std::move(faces);
  part.stretch = flat.stretch;
}

void require_disk(TriMesh const& mesh, std::vector<std::uint32_t> const& faces, std::size_t chart) {
  std::vector<Triangle> triangles;
  for (std::uint32_t f : faces) triangles.push_back(mesh.triangles[f]);
  if (std::string const defect = disk_defect(triangles); !defect.empty())
    throw Error(ErrorKind::invalid_input, "chart " + std::to_string(chart) + " is not a disk: it " + defect,
                "cut the mesh with segment()");
}

}  // namespace

FlatCharts parameterize(ChartedMesh const& charts) {
  std::vector<std::vector<std::uint32_t>> faces = faces_of_charts(charts.face_charts, charts.charts);
  std::vector<FlatChart> flat_charts(charts.charts);
  parallel_for(flat_charts.size(), 1, [&](std::size_t c) {
    require_disk(charts.mesh, faces[c], c);
    flatten_parts(charts.mesh, std::move(faces[c]), flat_charts[c]);
  });

  FlatCharts result;
  result.mesh = charts.mesh;
  result.face_charts.resize(charts.mesh.triangles.size());
  result.corner_uvs.resize(charts.mesh.triangles.size());
  for (FlatChart const& chart : flat_charts) {
    result.retries += chart.retries;
    for (FlatPart const& part : chart.parts) {
      for (std::size_t i = 0; i < part.faces.size(); ++i) {
        result.face_charts[part.faces[i]] = result.charts;
        result.corner_uvs[part.faces[i]] = part.corner_uvs[i];
      }
      result.stretch.push_back(float(part.stretch));
      ++result.charts;
    }
  }
  return result;
}

}  // namespace vitrine
