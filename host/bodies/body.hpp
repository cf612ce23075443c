// SPDX-License-Identifier: Apache-2.0
// A body as a list of flat convex facets with materials, in metres, in any frame of its own.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "radio/slab.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// The corners of a flat convex polygon, in order about its normal.
using Polygon = std::vector<glm::dvec3>;

// A wall's layers from its outer side inwards, at one frequency; none: a perfect conductor.
using BodyMaterial = std::vector<WallLayer>;

struct Facet {
  Polygon corners;        // counter-clockwise, seen from outside
  uint32_t material = 0;  // index into Body::materials
};

struct Body {
  std::vector<Facet> facets;
  std::vector<BodyMaterial> materials;
};

// True if the facets bound a volume: each edge has exactly two, which run through it in opposite directions (corners
// are compared bit by bit), and the volume is positive. Facets of such a body have one lit side, the outer one. Facets
// of other bodies are sheets, which have two.
bool is_closed(const Body& body);

// Throws InputError, with the number of the facet, for a body without facets, a facet of fewer than three corners, with
// a corner that is not finite, without area, not flat (1e-6 of its size), not convex, or of a material that is not
// there.
void check_body(const Body& body);

// The triangles of a scene or of a model of a vehicle, in the coordinates of its file, with its materials at the
// frequency. Volumes of vegetation are left out. Throws ConfigError if a material is not known at the frequency.
Body body_of(const Scene& scene, double frequency_hz);

}  // namespace wavetracer
