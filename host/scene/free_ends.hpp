// SPDX-License-Identifier: Apache-2.0
// Finds the free ends of edges, at which their waves end with the wave of a corner.
// The Scene must be complete, with its wedges.
#pragma once
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Sets Wedge::free_ends. A convex edge ends freely, at the corner of a roof or of a screen, unless it
// - stands on a surface, as on the ground, or runs into one: a line beside it crosses that surface within 1 cm;
// - goes on as another wedge, where a row of houses or a file cut it;
// - is shorter than 1 cm.
void mark_free_ends(Scene& scene);

}  // namespace wavetracer
