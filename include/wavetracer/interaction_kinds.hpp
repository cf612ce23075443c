// SPDX-License-Identifier: Apache-2.0
// The kinds of interaction, one row each: all code that numbers, names, counts or colours them uses this table.
// A new kind needs its code in paths.hpp, its step in device/records.h, its key in config.hpp and a row below.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "wavetracer/config.hpp"
#include "wavetracer/paths.hpp"
#include "wavetracer/ray_waypoints.hpp"

namespace wavetracer {

// Paths are named and drawn by the most special of their interactions.
struct PathKind {
  std::string_view word;         // in files and identifiers; texts have spaces instead of _
  std::string_view dark, light;  // its colour on a dark and on a light page
  size_t plot;                   // its colour in plots, see host/plots/gnuplot.hpp
};

struct InteractionKind {
  Interaction code;              // in files
  uint32_t step;                 // in the steps of solved paths on the device, see WT_STEP_KIND
  WaypointKind waypoint;         // in waypoints; WaypointKind::launch if rays do not do it
  std::string_view word;         // the name of the feature, and of the key in [trace]
  std::string_view legend;       // its name in descriptions in files
  PathKind paths;                // the paths whose most special interaction it is
  uint8_t deepmimo;              // its digit in the codes of DeepMIMO; 0 if it has none
  bool TraceConfig::*asked_for;  // the value of that key
};

// The least special comes first. A row: code, step and waypoint; words; paths; digit; key.
// clang-format off
inline constexpr std::array<InteractionKind, 5> interaction_kinds{{
    {reflection, 0, WaypointKind::reflection, "reflection", "reflection",
     {"reflected", "#36b3ff", "#002080", 5}, 1, &TraceConfig::reflection},
    {transmission, 1, WaypointKind::launch, "transmission", "transmission",
     {"transmitted", "#ff2fa5", "#f230f2", 2}, 4, &TraceConfig::transmission},
    {diffraction, 2, WaypointKind::diffraction, "diffraction", "diffraction",
     {"diffracted", "#12ff84", "#21a685", 6}, 2, &TraceConfig::diffraction},
    {scattering, 3, WaypointKind::launch, "scattering", "diffuse scattering",
     {"scattered", "#bb740d", "#804000", 3}, 3, &TraceConfig::scattering},
    {target_point, 4, WaypointKind::launch, "target", "target",
     {"echoed", "#94555a", "#336666", 1}, 0, &TraceConfig::target},
}};
// clang-format on
static_assert(std::ranges::all_of(interaction_kinds,
                                  [](const auto& kind) { return std::has_single_bit<uint8_t>(kind.code); }),
              "codes are joined as bits");

// Line of sight, then those of interaction_kinds in their order.
inline constexpr auto path_kinds = [] {
  std::array<PathKind, 1 + interaction_kinds.size()> all{{{"line_of_sight", "#ffffff", "#111111", 0}}};
  std::ranges::transform(interaction_kinds, all.begin() + 1, &InteractionKind::paths);
  return all;
}();

// The row of a code; nullptr if there is no such code.
constexpr const InteractionKind* find_interaction(uint8_t code) {
  const auto row = std::ranges::find(interaction_kinds, code, [](const auto& kind) { return +kind.code; });
  return row == interaction_kinds.end() ? nullptr : &*row;
}

// Returns "1 reflection, 2 diffuse scattering, ...", by their code.
inline std::string interaction_legend() {
  std::string legend;
  for (unsigned code = 1; code < 256; code *= 2)
    if (const InteractionKind* kind = find_interaction(static_cast<uint8_t>(code)))
      legend += (legend.empty() ? "" : ", ") + std::to_string(code) + " " + std::string(kind->legend);
  return legend;
}

}  // namespace wavetracer
