// SPDX-License-Identifier: Apache-2.0
#include "gradient/path_tables.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radio/constants.hpp"
#include "tangent/records.hpp"

namespace wavetracer {
namespace {

using tangent::Tangent;

template <class Record>
auto constants_of(const std::vector<Record>& records) {
  std::vector<decltype(tangent::constant(records.front()))> out;
  for (const Record& record : records) out.push_back(tangent::constant(record));
  return out;
}

glm::dvec3 value_of(const tangent::wt_double3& v) { return {v.x.value, v.y.value, v.z.value}; }

}  // namespace

ConstantTables constant_tables(const FieldTables& tables) {
  return {constants_of(tables.materials), constants_of(tables.foliages), constants_of(tables.antennas),
          constants_of(tables.volumes.volumes)};
}

PathTables::PathTables(const FieldTables& tables, const ConstantTables& constants, const FieldFrame& frame,
                       const device::wt_field_world& world)
    : tables_(tables),
      constants_(constants),
      frame_(frame),
      plain_(world),
      list_(frame.list()),
      inside_(tables.foliages.size()),
      materials_(constants.materials),
      foliages_(constants.foliages) {}

void PathTables::set_row(uint32_t row) {
  row_ = row;
  path_ = device::wt_path_of(&list_, frame_.rows[row]);
  list_neighbours();
}

// Rows of the same link whose delays are equal to a picosecond decide on which side of a boundary of an edge the path
// is. They are compared by their steps, so their vertices are not set.
void PathTables::list_neighbours() {
  const auto link = [&](uint32_t row) {
    const wt_solved& path = frame_.solved[frame_.rows[row] / 2];
    return Link{path.transmitter, path.receiver};
  };
  const auto near = [&](uint32_t row) {
    return link(row) == link(row_) && std::abs(frame_.delays[row] - frame_.delays[row_]) < 1e-12;
  };
  uint32_t begin = row_, end = row_ + 1;
  if (diffractions_of(path_) > 0) {
    while (begin > 0 && near(begin - 1)) --begin;
    while (end < frame_.rows.size() && near(end)) ++end;
  }
  place_ = row_ - begin;
  // The row itself is solved path 0.
  order_.assign(1, row_);
  for (uint32_t row = begin; row < end; ++row)
    if (row != row_) order_.push_back(row);
  max_depth_ = 1;
  for (const uint32_t row : order_) max_depth_ = std::max(max_depth_, frame_.solved[frame_.rows[row] / 2].depth);
  rows_.resize(end - begin);
  delays_.assign(frame_.delays.begin() + begin, frame_.delays.begin() + end);
  solved_.clear();
  steps_.clear();
  for (uint32_t i = 0; i < order_.size(); ++i) {
    const uint32_t number = frame_.rows[order_[i]] / 2;
    rows_[order_[i] - begin] = 2 * i;
    solved_.push_back(frame_.solved[number]);
    solved_.back().transmitter = solved_.back().receiver = 0;
    const auto first = frame_.steps.begin() + static_cast<ptrdiff_t>(size_t{number} * frame_.max_depth);
    steps_.insert(steps_.end(), first, first + std::min(max_depth_, frame_.max_depth));
    steps_.resize((i + 1) * max_depth_);
  }
  vertices_.resize(3 * order_.size() * max_depth_, 0.0);
}

std::span<const PathDirection> PathTables::material_directions() {
  std::vector<PathDirection>& out = directions_;
  out.clear();
  const auto add = [&](uint32_t material, std::initializer_list<PathParameter> parameters) {
    for (const PathParameter parameter : parameters)
      if (std::ranges::none_of(
              out, [&](const PathDirection& d) { return d.material == material && d.parameter == parameter; }))
        out.push_back({parameter, material});
  };
  const auto add_surface = [&](uint32_t surface) {
    const uint32_t material = tables_.materials_of[surface], layers = tables_.materials[material].layers;
    const uint32_t first = layers == 0 ? material : layers >> WT_LAYER_SHIFT;
    const uint32_t count = layers == 0 ? 1 : layers & WT_LAYER_COUNT;
    for (uint32_t i = 0; i < count; ++i)
      add(first + i, {PathParameter::permittivity, PathParameter::conductivity, PathParameter::thickness});
    if (tables_.scatters) add(material, {PathParameter::scattering});
  };
  for (uint32_t k = 0; k < path_.depth; ++k) {
    const uint32_t step = device::wt_step(&path_, k), number = step & ~WT_STEP_KIND, kind = step & WT_STEP_KIND;
    if (device::wt_is_cell(&plain_, step)) {
      const uint32_t leaves = tables_.surface_of_tile[number] >> WT_CELL_KIND_SHIFT & (WT_MOST_KINDS - 1);
      add(tables_.volumes.material[leaves],
          {PathParameter::scattering, PathParameter::attenuation, PathParameter::most_attenuation});
    } else if (kind == WT_STEP_DIFFRACTION) {
      for (const uint32_t surface : frame_.wedges[number].surfaces) add_surface(surface);
    } else {
      add_surface(kind == WT_STEP_SCATTERING ? tables_.surface_of_tile[number] : number);
    }
  }
  const size_t kinds = tables_.foliages.size(), solved = frame_.rows[row_] / 2;
  for (size_t kind = 0; kind < kinds; ++kind)
    if (frame_.inside[solved * kinds + kind] > 0)
      add(tables_.volumes.material[kind], {PathParameter::attenuation, PathParameter::most_attenuation});
  return out;
}

void PathTables::seed_material(const PathDirection& direction, int lane, double frequency_hz) {
  constexpr double np_of_db = std::numbers::ln10 / 20;
  tangent::wt_material& material = materials_[direction.material];
  const auto each_foliage = [&](auto change) {
    for (size_t kind = 0; kind < foliages_.size(); ++kind)
      if (tables_.volumes.material[kind] == direction.material) change(foliages_[kind]);
  };
  switch (direction.parameter) {
    case PathParameter::permittivity:
      material.permittivity[0].d.set(lane, 1);
      break;
    case PathParameter::conductivity:
      material.permittivity[1].d.set(lane, -1 / (2 * std::numbers::pi * frequency_hz * vacuum_permittivity_f_m));
      break;
    case PathParameter::thickness:
      material.thickness_m.d.set(lane, 1);
      break;
    case PathParameter::scattering:
      material.scattering.d.set(lane, 1);
      each_foliage([&](tangent::wt_foliage& leaves) { leaves.scattering.d.set(lane, 1); });
      break;
    case PathParameter::attenuation:
      each_foliage([&](tangent::wt_foliage& leaves) { leaves.loss_np_m.d.set(lane, np_of_db); });
      break;
    case PathParameter::most_attenuation:
      each_foliage([&](tangent::wt_foliage& leaves) {
        if (leaves.most_np >= 0.0) leaves.most_np.d.set(lane, np_of_db);  // below 0 there is no such limit
      });
      break;
    default:
      break;
  }
}

bool PathTables::is_singular(const PathDirection& direction) const {
  if (direction.parameter != PathParameter::most_attenuation) return false;
  for (size_t kind = 0; kind < tables_.foliages.size(); ++kind)
    if (tables_.volumes.material[kind] == direction.material && tables_.foliages[kind].most_np == 0) return true;
  return false;
}

// Seeds of the last call go, and all other entries of the tables are those of all paths.
void PathTables::take_seeds_back() {
  for (const PathDirection& direction : seeded_)
    materials_[direction.material] = constants_.materials[direction.material];
  if (!seeded_.empty()) foliages_ = constants_.foliages;
  seeded_.clear();
}

bool PathTables::solve_vertices() {
  moved_.set(plain_, path_);
  return moved_.solved;
}

// The ends and vertices as constants.
void PathTables::stay() {
  const auto set = [](Tangent* to, const glm::dvec3& p) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = p[axis];
  };
  set(from_, path_.from);
  set(to_, path_.to);
  for (uint32_t k = 0; k < path_.depth; ++k)
    set(&vertices_[3 * device::wt_entry(&path_, k)], device::wt_vertex(&path_, k));
}

void PathTables::move_ends() {
  const auto set = [](Tangent* to, const tangent::wt_double3& p) {
    to[0] = p.x;
    to[1] = p.y;
    to[2] = p.z;
  };
  set(from_, moved_.from);
  set(to_, moved_.to);
  for (uint32_t k = 0; k < path_.depth; ++k) set(&vertices_[3 * device::wt_entry(&path_, k)], moved_.vertices[k]);
  if (!foliages_.empty()) sum_inside();
}

// The derivatives of the metres in each kind of vegetation; their values are rounded sums, see wt_parts_of_length.
void PathTables::sum_inside() {
  const device::wt_volumes all = tables_.volumes.all();
  const tangent::wt_volumes moved{constants_.volumes.data(), all.triangles, all.earlier};
  Tangent sums[WT_MOST_KINDS] = {};
  tangent::wt_double3 from = moved_.from;
  for (uint32_t leg = 0; leg <= path_.depth; ++leg) {
    const tangent::wt_double3 to = leg < path_.depth ? moved_.vertices[leg] : moved_.to;
    for (uint32_t k = 0; k < tables_.volumes.volumes.size(); ++k)
      if (device::wt_length_inside(all.volumes + k, all.triangles, value_of(from), value_of(to)) > 0)
        sums[all.volumes[k].kind] += tangent::wt_length_in_space(moved, k, from, to);
    from = to;
  }
  for (size_t kind = 0; kind < inside_.size(); ++kind) inside_[kind] = with_value(inside_[kind].value, sums[kind]);
}

// Ends are copied where they are not those of the row before. A turn about axis e moves each column of the rotation by
// e x column.
void PathTables::set_end(tangent::wt_field_end& to, KnownEnd& known, const std::vector<device::wt_field_end>& ends,
                         uint32_t number, bool turns, int first_lane) {
  if (known.number == number && known.turns == turns) return;
  known = {number, turns};
  to = tangent::constant(ends[number]);
  for (int column = 0; turns && column < 3; ++column)
    for (int axis = 0; axis < 3; ++axis) {
      const int up = (axis + 1) % 3, after = (axis + 2) % 3, lane = first_lane + axis;
      to.rotation[3 * up + column].d.set(lane, -to.rotation[3 * after + column].value);
      to.rotation[3 * after + column].d.set(lane, to.rotation[3 * up + column].value);
    }
}

tangent::wt_field_world PathTables::moved_world() const {
  return {plain_.surfaces,
          plain_.materials_of,
          materials_.data(),
          plain_.wedges,
          plain_.surface_of_tile,
          plain_.area_of_tile,
          plain_.instances,
          &transmitter_,
          &receiver_,
          constants_.antennas.data(),
          plain_.samples,
          plain_.wavelength_m,
          plain_.seed,
          plain_.transmissions,
          plain_.reflections,
          plain_.scatters,
          plain_.foliage_count,
          foliages_.data(),
          inside_.data(),
          tangent::constant(plain_.air),
          nullptr,
          nullptr,
          nullptr,
          nullptr};
}

tangent::wt_path_field PathTables::fields(std::span<const PathDirection> directions, double frequency_hz,
                                          Tangent& delay) {
  const bool moves = !directions.empty() && directions[0].parameter == PathParameter::tx_x;
  const bool turns = !directions.empty() && directions[0].parameter == PathParameter::tx_turn_x;
  const size_t solved = frame_.rows[row_] / 2;
  for (size_t kind = 0; kind < inside_.size(); ++kind) inside_[kind] = frame_.inside[solved * inside_.size() + kind];
  take_seeds_back();
  moves ? move_ends() : stay();
  set_end(transmitter_, known_transmitter_, frame_.transmitters, path_.transmitter, turns, 0);
  set_end(receiver_, known_receiver_, frame_.receivers, path_.receiver, turns, 3);
  if (!moves && !turns) {
    seeded_.assign(directions.begin(), directions.end());
    for (size_t lane = 0; lane < directions.size(); ++lane)
      seed_material(directions[lane], static_cast<int>(lane), frequency_hz);
  }
  const tangent::wt_path_list list{solved_.data(), vertices_.data(), steps_.data(), from_, to_,
                                   nullptr,        nullptr,          max_depth_};
  const tangent::wt_ordered_rows ordered{&list, rows_.data(), delays_.data(), static_cast<uint32_t>(rows_.size())};
  const tangent::wt_field_world world = moved_world();
  const tangent::wt_path path = tangent::wt_path_of(&list, rows_[place_]);
  delay = tangent::wt_path_length(&path) / speed_of_light_m_s;
  return tangent::wt_field_of(&world, &ordered, place_);
}

}  // namespace wavetracer
