// SPDX-License-Identifier: Apache-2.0
// Helpers for writing rows of the field table, and the tables that are not in field_table.cpp itself. Only files with
// rows include it.
#pragma once
#include "config/field_table.hpp"

namespace wavetracer::config {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

template <class M>
Slot slot_of(M& member) {
  if constexpr (requires { member.stored(); })
    return ChoiceSlot{&member.stored(), M::words};
  else
    return &member;
}

// Accessors: a member, a member of a sub-struct of Config, a member of an element of a vector of Config.
template <class M>
auto at(M Config::*member) {
  return [member](Config& c, size_t) -> Slot { return slot_of(c.*member); };
}
template <class S, class M>
auto at(S Config::*part, M S::*member) {
  return [part, member](Config& c, size_t) -> Slot { return slot_of(c.*part.*member); };
}
template <class E, class M>
auto at(std::vector<E> Config::*list, M E::*member) {
  return [list, member](Config& c, size_t i) -> Slot { return slot_of((c.*list)[i].*member); };
}
template <class E, class M>
auto at(SharedList<E> Config::*list, M E::*member) {
  return [list, member](Config& c, size_t i) -> Slot { return slot_of((c.*list)[i].*member); };
}
template <auto List>
size_t append(Config& c) {
  (c.*List).emplace_back();
  return (c.*List).size() - 1;
}
template <auto List>
size_t count(const Config& c) {
  return (c.*List).size();
}

// Rows that radio ends and mounts share.
template <class Member>
Field antenna_field(const Member& member, auto antenna) {
  return {.name = "antenna",
          .slot = member(antenna),
          .choices = {NamedAntenna::words.begin(), NamedAntenna::words.end()},
          .form = Form::choice_or_file,
          .doc =
              "A built-in antenna, or a pattern file (CSV with the columns theta_deg,phi_deg,v_re,v_im,h_re,h_im). "
              "With isotropic the gains are those of the channel alone."};
}

template <class Member>
Field polarization_field(const Member& member, auto polarization) {
  return {.name = "polarization",
          .slot = member(polarization),
          .doc =
              "VH (V and H) and cross (+45 and -45 degrees) have two ports. The default is V, "
              "as usual for vehicle antennas."};
}

template <class Member>
Field array_field(const Member& member, auto array) {
  return {.name = "array",
          .slot = member(array),
          .doc =
              "Name of an [[array]], whose elements are placed around the position and turned by orientation_deg; "
              "each has the antenna and the polarization that are given here. Empty: one element."};
}

// Defined in array_fields.cpp; the first two are keys of [radio].
Field frequencies_field();
Field wavefront_field();
Table array_table();
Table response_table();

// Defined in cache_fields.cpp.
Table cache_table();

// Defined in live_fields.cpp: input at run time.
Table live_table();

// Defined in output_fields.cpp.
Table output_table();
Table live_vehicle_table();

// Defined in scene_fields.cpp: fixed objects.
Table scene_table();
Table material_table();
Table transmitter_table();
Table receiver_table();
Table station_table();

// Defined in grid_fields.cpp.
Table receiver_grid_table();

// Defined in outdoors_fields.cpp: the air and vegetation.
Table air_table();
Table vegetation_table();

// Defined in target_fields.cpp: targets of sensing.
Table target_model_table();
Table target_table();
// Defined in target_part_fields.cpp.
Table target_part_table();

// Defined in radar_fields.cpp.
Table radar_table();

// Defined in trace_fields.cpp: the search for paths.
Table trace_table();

// Defined in vehicle_fields.cpp: moving objects.
Table trajectories_table();
Table time_table();
Table links_table();
Table mount_table();
Table vehicle_type_table();
Table track_table();
Table parked_table();

}  // namespace wavetracer::config
