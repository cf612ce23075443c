// SPDX-License-Identifier: Apache-2.0
#include "radio/field_frame.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "radio/constants.hpp"
#include "radio/world_records.hpp"
#include "wavetracer/device/field_row.h"
#include "wavetracer/device/path_along.h"
#include "wavetracer/device/volumes.h"
#include "wavetracer/error.hpp"
#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer {
namespace {

// Throws std::out_of_range for a number that does not exist.
void check_numbers(const PathGeometry& paths, size_t surfaces, size_t wedges, size_t tiles, size_t targets) {
  for (size_t i = 0; i < paths.surface.size(); ++i) {
    const uint8_t kind = paths.interaction[i];
    if (kind == scattering && tiles == 0)
      throw RuntimeError("a path scatters from a tile, but there are none without trace.scattering");
    const size_t count = kind == diffraction    ? wedges
                         : kind == scattering   ? tiles
                         : kind == target_point ? targets
                                                : surfaces;
    if (paths.surface[i] >= count)
      throw std::out_of_range(
          fmt::format("a path has number {} of {} surfaces, wedges, tiles or targets", paths.surface[i], count));
  }
}

std::vector<double> positions(std::span<const EndState> ends) {
  std::vector<double> out;
  for (const EndState& end : ends) out.insert(out.end(), {end.position_m.x, end.position_m.y, end.position_m.z, -1.0});
  return out;
}

void add_solved(FieldFrame& rows, const PathGeometry& paths, const WorldState& state) {
  const auto depth = [&](size_t path) { return static_cast<uint32_t>(paths.first[path + 1] - paths.first[path]); };
  for (size_t path = 0; path < paths.size(); ++path) rows.max_depth = std::max(rows.max_depth, depth(path));
  rows.vertices.resize(3 * paths.size() * rows.max_depth);
  rows.steps.resize(paths.size() * rows.max_depth);
  for (size_t path = 0; path < paths.size(); ++path) {
    rows.solved.push_back({.transmitter = paths.tx[path],
                           .receiver = paths.rx[path],
                           .depth = depth(path),
                           .blocked = 0,
                           .node = WT_NONE,
                           .quarters = paths.quarters.empty() ? 0u : paths.quarters[path]});
    for (uint32_t k = 0; k < depth(path); ++k) {
      const uint64_t from = paths.first[path] + k, to = path * rows.max_depth + k;
      const InteractionKind* kind = find_interaction(paths.interaction[from]);
      if (!kind)
        throw RuntimeError(fmt::format("path {} has an interaction of kind {}, which fields do not know", path,
                                       paths.interaction[from]));
      rows.steps[to] = paths.surface[from] | kind->step << WT_STEP_SHIFT;
      for (int axis = 0; axis < 3; ++axis) rows.vertices[3 * to + axis] = paths.vertex[from][axis];
    }
  }
  rows.transmitter_positions = positions(state.transmitters);
  rows.receiver_positions = positions(state.receivers);
}

// Is the path of rows[at] a part of another one of its link? length: of each path; rows are ordered by them.
bool is_along(const device::wt_path_list& list, const device::wt_field_world& world, std::span<const double> length,
              std::span<const uint32_t> rows, size_t at) {
  const device::wt_path path = device::wt_path_of(&list, 2 * rows[at]);
  for (const int way : {-1, 1})
    for (size_t i = at + way; i < rows.size(); i += way) {  // before 0 is beyond the size
      const device::wt_path other = device::wt_path_of(&list, 2 * rows[i]);
      if (other.transmitter != path.transmitter || other.receiver != path.receiver ||
          !(std::abs(length[rows[i]] - length[rows[at]]) <= WT_ALONG_LENGTH_M))
        break;
      if (device::wt_is_along(&world, &path, length[rows[at]], &other, length[rows[i]])) return true;
    }
  return false;
}

void add_ordered(FieldFrame& frame, const device::wt_field_world& world, LeftOut& left_out) {
  const device::wt_path_list list = frame.list();
  const auto count = static_cast<uint32_t>(frame.solved.size());
  std::vector<uint32_t> kept;
  std::vector<double> delay(count), length(count);
  for (uint32_t i = 0; i < count; ++i) {
    const device::wt_path path = device::wt_path_of(&list, 2 * i);
    length[i] = device::wt_path_length(&path);
    delay[i] = length[i] / speed_of_light_m_s;
    if (device::wt_is_near(&world, &path))
      ++left_out[{path.transmitter, path.receiver}];
    else
      kept.push_back(i);
  }
  std::ranges::sort(kept, [&](uint32_t i, uint32_t j) {
    const device::wt_path a = device::wt_path_of(&list, 2 * i), b = device::wt_path_of(&list, 2 * j);
    const Link link_a{a.transmitter, a.receiver}, link_b{b.transmitter, b.receiver};
    return link_a != link_b ? link_a < link_b : device::wt_compare_rows(&a, &b, delay[i], delay[j]) < 0;
  });
  for (size_t at = 0; at < kept.size(); ++at) {
    if (is_along(list, world, length, kept, at)) continue;
    frame.rows.push_back(2 * kept[at]);
    frame.delays.push_back(delay[kept[at]]);
  }
}

// The metres of each path inside of each kind of vegetation.
std::vector<double> lengths_inside(const VolumeTable& table, const device::wt_path_list& list, size_t count) {
  const size_t kinds = table.material.size();
  const device::wt_volumes all = table.all();
  std::vector<double> out(count * kinds);
  tbb::parallel_for(size_t{0}, count, [&](size_t i) {
    std::vector<uint64_t> inside(kinds);
    const device::wt_path path = device::wt_path_of(&list, static_cast<uint32_t>(2 * i));
    glm::dvec3 from = path.from;
    for (uint32_t leg = 0; leg <= path.depth; ++leg) {
      const glm::dvec3 to = leg < path.depth ? device::wt_vertex(&path, leg) : path.to;
      for (uint32_t k = 0; k < table.volumes.size(); ++k)
        inside[table.volumes[k].kind] += device::wt_parts_of_length(device::wt_length_in_space(all, k, from, to));
      from = to;
    }
    std::ranges::transform(inside, out.begin() + static_cast<ptrdiff_t>(i * kinds), device::wt_length_of_parts);
  });
  return out;
}

}  // namespace

device::wt_path_list FieldFrame::list() const {
  return {solved.data(), vertices.data(), steps.data(), transmitter_positions.data(), receiver_positions.data(),
          nullptr,       nullptr,         max_depth};
}

device::wt_field_world FieldFrame::world(const FieldTables& tables) const {
  return {surfaces.data(),
          tables.materials_of.data(),
          tables.materials.data(),
          wedges.data(),
          tables.surface_of_tile.data(),
          tables.area_of_tile.data(),
          instances.data(),
          transmitters.data(),
          receivers.data(),
          tables.antennas.data(),
          tables.samples.data(),
          tables.wavelength_m,
          tables.seed,
          tables.transmissions,
          tables.reflections,
          tables.scatters,
          static_cast<uint32_t>(tables.foliages.size()),
          tables.foliages.data(),
          inside.data(),
          tables.air,
          targets.data(),
          tables.targets.laws.data(),
          tables.targets.lobes.data(),
          tables.targets.facets.data()};
}

FieldFrame make_field_frame(const FieldTables& tables, const Scene& scene, std::span<const Scene> models,
                            std::span<const Instance> instances, const PathGeometry& geometry, const WorldState& state,
                            LeftOut* left_out) {
  FieldFrame frame;
  add_solved(frame, geometry, state);
  frame.has_quarters = !geometry.quarters.empty();
  frame.surfaces = surface_records(scene, models, instances, state);
  frame.wedges = wedge_records(scene, models, instances);
  place_wedges(frame.wedges, state);
  check_numbers(geometry, frame.surfaces.size(), frame.wedges.size(), tables.surface_of_tile.size(),
                state.targets.size());
  frame.instances = instance_records(instances, state);
  frame.targets = target_records(state);
  if (!tables.foliages.empty()) frame.inside = lengths_inside(tables.volumes, frame.list(), geometry.size());
  frame.transmitters = field_ends(state.transmitters, 0);
  frame.receivers = field_ends(state.receivers, tables.transmitters);
  LeftOut near;
  add_ordered(frame, frame.world(tables), near);
  if (left_out) *left_out = std::move(near);
  return frame;
}

Paths paths_of(const FieldFrame& frame, const FieldTables& tables, const glm::dvec3& origin_m, uint32_t number) {
  const device::wt_path_list list = frame.list();
  const device::wt_field_world world = frame.world(tables);
  std::vector<uint32_t> first_vertex{0};
  for (const uint32_t row : frame.rows) first_vertex.push_back(first_vertex.back() + frame.solved[row / 2].depth);
  std::vector<device::wt_path_row> path_rows(frame.rows.size());
  std::vector<device::wt_vertex_row> vertex_rows(first_vertex.back());
  const device::wt_ordered_rows rows{&list, frame.rows.data(), frame.delays.data(),
                                     static_cast<uint32_t>(frame.rows.size())};
  tbb::parallel_for(tbb::blocked_range<uint32_t>(0, rows.count, 64), [&](const tbb::blocked_range<uint32_t>& range) {
    for (uint32_t row = range.begin(); row < range.end(); ++row)
      device::wt_write_row(&world, &rows, row, frame.solved[frame.rows[row] / 2].quarters, origin_m, first_vertex[row],
                           &path_rows[row], vertex_rows.data());
  });
  Paths paths = columns_of({path_rows, vertex_rows, number}, tables.ports);
  if (!frame.has_quarters) paths.quarters.clear();
  return paths;
}

}  // namespace wavetracer
