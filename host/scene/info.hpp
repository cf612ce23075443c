// SPDX-License-Identifier: Apache-2.0
// Describes a loaded scene as text for people.
// The Scene comes from load.hpp; only sums are computed.
#pragma once
#include <string>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Returns extent, triangles, surfaces, edges, materials, dropped triangles and warnings; each line ends in \n.
std::string describe_scene(const Scene& scene);

// Returns the edges that can diffract, one per line below a header line: number, ends (file coordinates), length,
// interior angle (degrees; 0 for a free edge), surfaces with their materials.
std::string describe_edges(const Scene& scene);

}  // namespace wavetracer
