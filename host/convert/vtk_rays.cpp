// SPDX-License-Identifier: Apache-2.0
// Rows of one ray follow each other.
#include "convert/vtk_rays.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

VtkFile rays_file(const WaypointRows& rows) {
  std::vector<glm::dvec3> points;
  std::vector<int64_t> connectivity, ends, sample, surface, vehicle;
  std::vector<uint32_t> tx, depth;
  std::vector<uint8_t> kind, source;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (rows.kind[i] == WaypointKind::hit) continue;
    if (rows.kind[i] == WaypointKind::launch) {
      if (!points.empty()) ends.push_back(static_cast<int64_t>(points.size()));
      tx.push_back(rows.tx[i]);
      sample.push_back(static_cast<int64_t>(rows.sample[i]));
    }
    connectivity.push_back(static_cast<int64_t>(points.size()));
    points.push_back(rows.position_m[i]);
    depth.push_back(rows.depth[i]);
    kind.push_back(static_cast<uint8_t>(rows.kind[i]));
    source.push_back(static_cast<uint8_t>(rows.source[i]));
    surface.push_back(rows.surface[i] == no_surface ? -1 : int64_t{rows.surface[i]});
    vehicle.push_back(rows.instance[i] == no_instance ? -1 : int64_t{rows.instance[i]});
  }
  if (!points.empty()) ends.push_back(static_cast<int64_t>(points.size()));
  VtkFile file;
  file.add_points(points);
  file.add_cells(VtkFile::lines, connectivity, ends);
  file.add(VtkFile::cell_data, "tx", tx);
  file.add(VtkFile::cell_data, "sample", sample);
  file.add(VtkFile::point_data, "depth", depth);
  file.add(VtkFile::point_data, "kind", kind);
  file.add(VtkFile::point_data, "source", source);
  file.add(VtkFile::point_data, "surface", surface);
  file.add(VtkFile::point_data, "vehicle", vehicle);
  return file;
}

}  // namespace wavetracer
