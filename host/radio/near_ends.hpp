// Antennas that touch a surface or each other. The rule: an end that is at most WT_ON_SURFACE_M from the plane of a
// surface stands on it, and the surface is no mirror next to that end; ends at most as far from each other have no line
// of sight. Both ends of a path are treated alike, so that channels are reciprocal.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "radio/surface_table.hpp"
#include "wavetracer/path_geometry.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// How many paths of a link the rule has left out.
using LeftOut = std::map<Link, uint32_t>;

// The paths that the rule leaves, in their order; left_out: of the others.
PathGeometry without_near_ends(PathGeometry paths, const SurfaceTable& surfaces, const WorldState& state,
                               LeftOut& left_out);

using EndName = std::function<std::string(uint32_t end)>;
// What to tell the user where anything was left out.
std::string left_out_warning(const LeftOut& left_out, const EndName& tx_name, const EndName& rx_name);

}  // namespace wavetracer
