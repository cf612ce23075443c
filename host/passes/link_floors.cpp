// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/fields/link_floors.cl.
// Floors are in the units of bend_floors.hpp.
#include "passes/link_floors.hpp"

#include <cmath>
#include <vector>

#include "passes/bend_floors.hpp"
#include "passes/read_room.hpp"
#include "radio/most_power.hpp"
#include "radio/reflectance_bounds.hpp"

namespace wavetracer {
namespace {

constexpr double left_out_units = 1 << 24;  // those of the power of a link's strongest path without edges
constexpr uint32_t links_of_item = 64;      // those of a work-item of most_left_out

gpu::Definitions floors_build(const FieldTables& tables) {
  return {{"WT_DIFFRACTS", "0"},
          {"WT_SCATTERS", "0"},
          {"WT_CELLS", "0"},
          {"WT_TARGETS", "0"},
          {"WT_LAYERS", tables.layered() ? "1" : "0"},
          {"WT_LOSSES", tables.loses() ? "1" : "0"}};
}

// Bounds of what each material reflects, WT_COSINES for each.
std::vector<float> reflectances_of(const FieldTables& tables) {
  std::vector<float> out;
  for (size_t i = 0; i < tables.materials.size(); ++i) {
    const CosineBounds bounds = reflectance_bounds(tables.materials, i, tables.wavelength_m);
    out.insert(out.end(), bounds.begin(), bounds.end());
  }
  return out;
}

}  // namespace

LinkFloors::LinkFloors(gpu::Context& context, const FieldTables& tables, double range_db, bool passes)
    : context_(context),
      kernel_(context, floors_build(tables)),
      most_kernel_(context, floors_build(tables)),
      work_(tuning_of(context.info()).exact),
      arguments_{.wavelength_m = tables.wavelength_m,
                 .scale = bend_floors(-range_db, tables.wavelength_m, passes).one,
                 .air = tables.air,
                 .visible_count = 0,
                 .visible_counter = 0,
                 .max_depth = 0,
                 .receiver_count = 0,
                 .transmissions = tables.transmissions,
                 .scatters = tables.scatters,
                 .reflections = tables.reflections,
                 .foliage_count = static_cast<uint32_t>(tables.foliages.size())},
      second_(1 / bent_waves(tables.wavelength_m, passes).wave_m),
      left_out_unit_(static_cast<float>(left_out_units * std::pow(10.0, -range_db / 10))),
      most_powers_(context.buffer(most_powers(tables), "largest gains of antennas")),
      reflectances_(context.buffer(reflectances_of(tables), "reflectances")),
      most_(context.buffer<uint32_t>(1, "largest part that a link lacks")) {}

void LinkFloors::operator()(const UnbentPaths& paths, Counters& counters) {
  const RadioEnds& ends = paths.ends;
  const SolvedList& visible = paths.visible;
  arguments_.receiver_count = ends.receiver_count;
  links_ = ends.transmitter_count * ends.receiver_count;
  const uint32_t none = 0;
  make_room(context_, floors_, links_, "floors of links");
  make_room(context_, left_out_, links_, "parts that links lack");
  if (links_ == 0) return;
  context_.fill(floors_, &none, sizeof none, 0, size_t{links_} * sizeof none, Stage::link_floors);
  context_.fill(left_out_, &none, sizeof none, 0, size_t{links_} * sizeof none, Stage::link_floors);
  arguments_.visible_count = visible.count;
  arguments_.visible_counter = visible.counter;
  arguments_.max_depth = visible.max_depth;
  if (visible.count == 0) return;
  kernel_(work_.range(visible.count), Stage::link_floors,
          calls::link_floors::link_floors{.solved = visible.headers,
                                          .vertices = visible.vertices,
                                          .steps = visible.sequences,
                                          .transmitter_places = ends.transmitters,
                                          .receiver_places = ends.receivers,
                                          .receiver_of = paths.receiver_of,
                                          .transmitter_of = paths.transmitter_of,
                                          .surfaces = paths.scene.exact_surfaces,
                                          .materials_of = paths.tables.materials_of,
                                          .materials = paths.tables.materials,
                                          .instances = paths.scene.exact_instances,
                                          .transmitters = paths.tables.transmitters,
                                          .receivers = paths.tables.receivers,
                                          .antennas = paths.tables.antennas,
                                          .samples = paths.tables.samples,
                                          .most_powers = most_powers_,
                                          .foliages = paths.tables.foliages,
                                          .lengths_inside = paths.lengths_inside,
                                          .floors = gpu::Global<uint32_t>::bits_of(&floors_),
                                          .counters = counters.buffer(),
                                          .args = arguments_});
}

double LinkFloors::most_left_out() {
  if (links_ == 0) return 0;
  const uint32_t none = 0;
  context_.fill(most_, &none, sizeof none, 0, sizeof none, Stage::link_floors);
  most_kernel_(work_.range((links_ + links_of_item - 1) / links_of_item), Stage::link_floors,
               calls::link_floors::most_left_out{.left_out = left_out_, .count = links_, .most = most_});
  return most_.read_one(0, Stage::link_floors) / left_out_units;
}

}  // namespace wavetracer
