// SPDX-License-Identifier: Apache-2.0
#include "stages/parameterize.h"

#include "stages/chart_topology.h"
#include "stages/error.h"
#include "stages/flatten.h"
#include "stages/parallel.h"
#include "stages/relax.h"

#include <utility>

namespace vitrine {
namespace {

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

/// The map relaxed, where it stays one.
FlatDisk relaxed(TriMesh const& disk, FlatDisk conformal, std::vector<std::uint32_t> const& faces,
                 std::vector<float> const& all) {
  std::vector<float> lengths;
  for (std::uint32_t f : faces) lengths.push_back(all[f]);
  std::vector<V2f> uvs = relax(disk, conformal.uvs, lengths);
  if (uvs.empty()) return conformal;
  FlatDisk flat = judged(disk, std::move(uvs));
  return flat.folded || flat.overlapping ? conformal : flat;
}

/// Flattens these faces, in parts where they do not lie flat as one.
void flatten_parts(TriMesh const& mesh, std::vector<std::uint32_t> faces, std::vector<float> const& lengths,
                   FlatChart& chart) {
  TriMesh const disk = submesh(mesh, faces);
  FlatDisk flat = flatten(disk);
  if (faces.size() > 1 && !lies_flat(flat, kBearable)) {
    ++chart.retries;
    for (std::vector<std::uint32_t>& part : cut_disk(disk)) {
      for (std::uint32_t& f : part) f = faces[f];
      flatten_parts(mesh, std::move(part), lengths, chart);
    }
    return;
  }
  if (!lengths.empty() && lies_flat(flat, kBearable)) flat = relaxed(disk, std::move(flat), faces, lengths);
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

FlatCharts parameterize(ChartedMesh const& charts, std::vector<float> const& lengths) {
  std::vector<std::vector<std::uint32_t>> faces = faces_of_charts(charts.face_charts, charts.charts);
  std::vector<FlatChart> flat_charts(charts.charts);
  parallel_for(flat_charts.size(), 1, [&](std::size_t c) {
    require_disk(charts.mesh, faces[c], c);
    flatten_parts(charts.mesh, std::move(faces[c]), lengths, flat_charts[c]);
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
