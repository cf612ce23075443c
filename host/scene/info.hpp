// What a loaded scene contains, as text for people.
// Assumes a Scene from load.hpp; nothing is recomputed but sums.
#pragma once
#include <string>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Extent, triangles, surfaces, edges, materials, what was dropped, warnings; lines end in \n.
std::string describe_scene(const Scene& scene);

// The edges that can diffract, one per line below a header line: number, ends (file coordinates), length, interior
// angle (degrees; 0: a free edge), surfaces with their materials.
std::string describe_edges(const Scene& scene);

}  // namespace wavetracer
