// What a loaded scene contains, as text for people.
// Assumes a Scene from load.hpp; nothing is recomputed but sums.
#pragma once
#include <string>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Extent, triangles, surfaces, edges, materials, what was dropped, warnings; lines end in \n.
std::string describe_scene(const Scene& scene);

}  // namespace wavetracer
