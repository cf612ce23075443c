// SPDX-License-Identifier: Apache-2.0
// Rows are made as on devices, in the order of links; then they are computed row by row, on all cores.
#include "radio/fields.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "radio/antenna.hpp"
#include "radio/constants.hpp"
#include "radio/world_records.hpp"
#include "wavetracer/device/path_along.h"
#include "wavetracer/device/path_field.h"
#include "wavetracer/device/volumes.h"
#include "wavetracer/error.hpp"
#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer {
namespace {

glm::dvec3 to_vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

// A geometry as solved paths, with a row for each path as it is.
struct SolvedRows {
  std::vector<wt_solved> solved;
  std::vector<double> vertices, transmitters, receivers;
  std::vector<uint32_t> steps;
  uint32_t max_depth = 1;

  device::wt_path_list list() const {
    return {solved.data(),    vertices.data(), steps.data(), transmitters.data(),
            receivers.data(), nullptr,         nullptr,      max_depth};
  }
};

// Throws std::out_of_range for a number that does not exist.
void check_numbers(const PathGeometry& paths, size_t surfaces, size_t wedges, size_t tiles) {
  for (size_t i = 0; i < paths.surface.size(); ++i) {
    const uint8_t kind = paths.interaction[i];
    if (kind == scattering && tiles == 0)
      throw RuntimeError("a path scatters from a tile, but there are none without trace.scattering");
    const size_t count = kind == diffraction ? wedges : kind == scattering ? tiles : surfaces;
    if (paths.surface[i] >= count)
      throw std::out_of_range(
          fmt::format("a path has number {} of {} surfaces, wedges or tiles", paths.surface[i], count));
  }
}

std::vector<double> positions(std::span<const EndState> ends) {
  std::vector<double> out;
  for (const EndState& end : ends) out.insert(out.end(), {end.position_m.x, end.position_m.y, end.position_m.z, -1.0});
  return out;
}

SolvedRows solved_rows(const PathGeometry& paths, const WorldState& state) {
  SolvedRows rows;
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
  rows.transmitters = positions(state.transmitters);
  rows.receivers = positions(state.receivers);
  return rows;
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

// The rows of a frame in their order, and their delays.
struct OrderedRows {
  std::vector<uint32_t> rows;
  std::vector<double> delays;
};

OrderedRows ordered_rows(const device::wt_path_list& list, const device::wt_field_world& world, size_t count,
                         LeftOut& left_out) {
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
  OrderedRows ordered;
  for (size_t at = 0; at < kept.size(); ++at) {
    if (is_along(list, world, length, kept, at)) continue;
    ordered.rows.push_back(2 * kept[at]);
    ordered.delays.push_back(delay[kept[at]]);
  }
  return ordered;
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

FieldModel::FieldModel(const Scene& scene, const Config& config, std::span<const Scene> models,
                       std::span<const Instance> instances)
    : scene_(scene),
      models_(models),
      instances_(instances.begin(), instances.end()),
      tables_(make_field_tables(scene, config, models, instances)) {
  const auto still = [&](const std::vector<RadioEnd>& ends, SharedList<EndState>& states) {
    for (const RadioEnd& end : ends)
      states.push_back({.position_m = to_vector(end.position_m) - scene.origin_m,
                        .rotation = rotation_of(end.orientation_deg),
                        .velocity_m_s = to_vector(end.velocity_m_s)});
  };
  still(config.transmitters, still_.transmitters);
  still(config.receivers, still_.receivers);
}

Paths FieldModel::compute(uint32_t frame, const PathGeometry& geometry, const WorldState& state,
                          LeftOut* left_out) const {
  const SolvedRows solved = solved_rows(geometry, state);
  const device::wt_path_list list = solved.list();
  const auto surfaces = surface_records(scene_, models_, instances_, state);
  auto wedges = wedge_records(scene_, models_, instances_);
  place_wedges(wedges, state);
  check_numbers(geometry, surfaces.size(), wedges.size(), tables_.surface_of_tile.size());
  const auto instances = instance_records(instances_, state);
  const std::vector<double> inside =
      tables_.foliages.empty() ? std::vector<double>{} : lengths_inside(tables_.volumes, list, geometry.size());
  const auto transmitters = field_ends(state.transmitters, 0);
  const auto receivers = field_ends(state.receivers, tables_.transmitters);
  const device::wt_field_world world{surfaces.data(),
                                     tables_.materials_of.data(),
                                     tables_.materials.data(),
                                     wedges.data(),
                                     tables_.surface_of_tile.data(),
                                     tables_.area_of_tile.data(),
                                     instances.data(),
                                     transmitters.data(),
                                     receivers.data(),
                                     tables_.antennas.data(),
                                     tables_.samples.data(),
                                     tables_.wavelength_m,
                                     tables_.seed,
                                     tables_.transmissions,
                                     tables_.reflections,
                                     tables_.scatters,
                                     static_cast<uint32_t>(tables_.foliages.size()),
                                     tables_.foliages.data(),
                                     inside.data(),
                                     tables_.air};
  LeftOut near;
  const OrderedRows ordered = ordered_rows(list, world, geometry.size(), near);
  if (left_out) *left_out = std::move(near);

  std::vector<uint32_t> first_vertex{0};
  for (const uint32_t row : ordered.rows) first_vertex.push_back(first_vertex.back() + solved.solved[row / 2].depth);
  std::vector<device::wt_path_row> path_rows(ordered.rows.size());
  std::vector<device::wt_vertex_row> vertex_rows(first_vertex.back());
  const device::wt_ordered_rows rows{&list, ordered.rows.data(), ordered.delays.data(),
                                     static_cast<uint32_t>(ordered.rows.size())};
  tbb::parallel_for(tbb::blocked_range<uint32_t>(0, rows.count, 64), [&](const tbb::blocked_range<uint32_t>& range) {
    for (uint32_t row = range.begin(); row < range.end(); ++row)
      device::wt_write_row(&world, &rows, row, solved.solved[ordered.rows[row] / 2].quarters, scene_.origin_m,
                           first_vertex[row], &path_rows[row], vertex_rows.data());
  });
  Paths paths = columns_of({path_rows, vertex_rows, frame}, tables_.ports);
  if (geometry.quarters.empty()) paths.quarters.clear();
  return paths;
}

Paths compute_paths(const Scene& scene, const Config& config, uint32_t frame, const PathGeometry& geometry) {
  return FieldModel(scene, config).compute(frame, geometry);
}

}  // namespace wavetracer
