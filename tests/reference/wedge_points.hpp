// SPDX-License-Identifier: Apache-2.0
// Finds where a path bends at wedges, by bisection on the derivative of its length (Fermat): no closed form is used.
// Wedges are as wavetracer/scene.hpp defines them.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include "wavetracer/scene.hpp"

namespace wavetracer::reference {

// The point p of the edge, its ends included, at which the length |a - p| + |p - b| is stationary.
std::optional<glm::dvec3> diffraction_point(const Wedge& wedge, const glm::dvec3& a, const glm::dvec3& b);

// The points p of the first and q of the second edge at which |a - p| + |p - q| + |q - b| is stationary.
std::optional<std::array<glm::dvec3, 2>> diffraction_points(const Wedge& first, const Wedge& second,
                                                            const glm::dvec3& a, const glm::dvec3& b);

// Tells whether the direction from a point of the edge to its neighbour on the path is in the wedge's sector of free
// space, faces included (to 1e-9 rad). A neighbour on the edge's own line is in none.
bool in_free_sector(const Wedge& wedge, const glm::dvec3& point, const glm::dvec3& neighbour);

// Less than half a turn of free space; such edges are in no path over two.
bool is_corner(const Wedge& wedge);

// Tells whether a corner wider than a right angle, or a bend of less than a milliradian, diffracts less than a
// hundredth of any wave that ends at it, from a to b: all boundaries are far away, in angles about the edge.
bool is_faint(const Wedge& wedge, const glm::dvec3& a, const glm::dvec3& b, double wavelength_m);

}  // namespace wavetracer::reference
