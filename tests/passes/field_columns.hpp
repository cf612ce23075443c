// SPDX-License-Identifier: Apache-2.0
// The columns of paths as the pass fields computes them on the device, in every way that it has, and on the host.
#pragma once
#include <doctest/doctest.h>

#include <utility>
#include <vector>

#include "passes/field_world.hpp"
#include "passes/fields.hpp"
#include "passes/wedges.hpp"
#include "radio/fields.hpp"
#include "wavetracer/device/path_rows.h"

namespace wavetracer::test {

inline constexpr uint32_t no_path = WT_NO_ROW;

inline bool same_columns(const Paths& a, const Paths& b) {
  return a.frame == b.frame && a.tx == b.tx && a.rx == b.rx && a.depth == b.depth && a.delay_s == b.delay_s &&
         a.gain_db == b.gain_db && a.a == b.a && a.aod_theta_rad == b.aod_theta_rad && a.aod_phi_rad == b.aod_phi_rad &&
         a.aoa_theta_rad == b.aoa_theta_rad && a.aoa_phi_rad == b.aoa_phi_rad && a.doppler_hz == b.doppler_hz &&
         a.quarters == b.quarters && a.vertex_offset == b.vertex_offset && a.vertex_position_m == b.vertex_position_m &&
         a.vertex_interaction == b.vertex_interaction && a.vertex_surface == b.vertex_surface &&
         a.vertex_instance == b.vertex_instance;
}

// Computes every third of these paths once more: those have their columns, in their order.
inline void check_chosen(Fields& fields, const FieldInputs& inputs, const WorldState& state, const Paths& paths) {
  std::vector<uint32_t> chosen;
  for (uint32_t row = 0; row < paths.size(); row += 3) chosen.push_back(row);
  const RowChoice choice = fields.choose(inputs.rows, chosen);
  REQUIRE(choice.count == chosen.size());
  fields.again(inputs, choice);
  fields.begin_read_carrier({choice.count, 0});
  context().finish();
  const CarrierFields again = fields.carrier({choice.count, 0});
  REQUIRE(again.a.size() == chosen.size());
  for (size_t i = 0; i < chosen.size(); ++i) {
    CHECK(again.a[i] == paths.a[chosen[i]]);
    CHECK(again.gain_db[i] == paths.gain_db[chosen[i]]);
  }
  fields(inputs, state, {static_cast<uint32_t>(paths.size()), static_cast<uint32_t>(paths.vertex_position_m.size())});
}

// Computes rows at their places on the device. numbers: twice the number of a path, plus one for its way back, or
// no_path. receiver_of, transmitter_of: ends in one place.
inline Paths fields_of(const FieldWorld& world, const std::vector<uint32_t>& numbers,
                       const std::vector<uint32_t>& receiver_of, const std::vector<uint32_t>& transmitter_of) {
  const auto places = static_cast<uint32_t>(numbers.size());
  RowList list;
  list.places = places;
  std::vector<double> delays(places, 0);
  std::vector<uint32_t> before(2 * places + 1);  // sums of ones, then of depths
  RowCounts count;
  for (uint32_t place = 0; place < places; ++place) {
    before[place] = count.rows;
    if (numbers[place] == no_path) continue;
    delays[place] = world.length_m(numbers[place] / 2) / light_m_s;
    ++count.rows;
  }
  for (uint32_t place = 0; place < places; ++place) {
    before[places + place] = count.rows + count.vertices;
    if (numbers[place] != no_path) count.vertices += static_cast<uint32_t>(world.rows[numbers[place] / 2].steps.size());
  }
  list.rows = context().buffer(numbers, "rows");
  list.counts = context().buffer(before, "rows before");
  list.delays = context().buffer(delays, "delays");
  list.quarters = context().buffer(std::vector<uint8_t>(places, WT_ALL_QUARTERS), "quarters");

  const DeviceScene scene = make_device_scene(context(), world.scene, false, 200);
  const Wedges wedges(context(), world.scene, {}, {}, true);
  const Distinct distinct(context(), receiver_of, transmitter_of);
  const RadioEnds ends = make_radio_ends(context(), world.state.transmitters, world.state.receivers, {});
  const SolvedList visible = upload_rows(world.rows, most_steps);
  const FieldTables tables = make_field_tables(world.scene, world.config);
  CHECK(tables.corners);
  const FieldInputs inputs{scene, &wedges.list().wedges, nullptr, ends, visible, nullptr, distinct, list};
  const auto computed = [&](bool apart) {
    Fields fields(context(), tables, 1, world.scene.origin_m, apart);
    fields(inputs, world.state, count);
    return fields;
  };
  Fields together = computed(false);
  together.begin_read(5, count);
  together.size_room();
  context().finish();
  const Paths all_together = together.columns(count);
  Fields fields = computed(true);
  fields.begin_read(5, {count.rows / 2, count.vertices / 2});  // the rest is read once their number is known
  fields.size_room();
  context().finish();
  Paths paths = fields.columns(count);
  CHECK(same_columns(paths, all_together));
  check_chosen(fields, inputs, world.state, paths);
  for (const uint32_t expected : {count.rows, count.rows + count.rows / 8}) {  // in parts, if there are many
    fields.begin_read(5, {expected, count.vertices + 7});
    fields.size_room();
    fields.fill_arriving(count);
    context().finish();
    Paths again = fields.columns(count);
    CHECK(same_columns(again, paths));
    fields.give_room(std::move(again));
  }
  return paths;
}

inline Paths in_order(const FieldWorld& world) {
  std::vector<uint32_t> numbers;
  for (uint32_t i = 0; i < world.rows.size(); ++i) numbers.push_back(2 * i);
  const std::vector<uint32_t> alone(numbers.size(), WT_NONE);
  return fields_of(world, numbers, alone, alone);
}

// The same rows by the host's evaluation of the same functions.
inline Paths on_host(const FieldWorld& world) {
  PathGeometry geometry;
  for (uint32_t i = 0; i < world.rows.size(); ++i) {
    const PathRow& row = world.rows[i];
    geometry.tx.push_back(i);
    geometry.rx.push_back(i);
    geometry.quarters.push_back(WT_ALL_QUARTERS);
    for (size_t k = 0; k < row.steps.size(); ++k) {
      geometry.surface.push_back(row.steps[k] & ~WT_STEP_KIND);
      geometry.interaction.push_back(static_cast<uint8_t>(WT_STEP_CODES >> 8 * (row.steps[k] >> WT_STEP_SHIFT)));
      geometry.vertex.push_back(row.points[k]);
    }
    geometry.first.push_back(geometry.surface.size());
  }
  return FieldModel(world.scene, world.config).compute(5, geometry, world.state);
}

}  // namespace wavetracer::test
