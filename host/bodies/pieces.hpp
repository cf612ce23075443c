// SPDX-License-Identifier: Apache-2.0
// Cutting of lit parts until the phase over each piece is linear, and the field of a piece.
#pragma once
#include <functional>

#include "bodies/lit_parts.hpp"
#include "bodies/physical_optics.hpp"
#include "wavetracer/device/facet.h"

namespace wavetracer {

using PieceTest = std::function<bool(const Polygon& piece, glm::dvec3 centre, double radius_m)>;

// Halves the polygon, across the direction in which it is longest, until each piece is small enough. Throws ConfigError
// for a piece with a radius below smallest_m that is not.
std::vector<Polygon> pieces_of(const Polygon& polygon, const PieceTest& small_enough, double smallest_m);

// The waves of one beam on one facet, on their way to a receiver.
struct FacetWave {
  const Body& body;
  const LitParts& lit;
  const Beam& beam;
  uint32_t facet;
  glm::dvec3 receiver;
  double wavelength_m;

  // The echo of a part of the facet that the beam lights. Throws ConfigError as pieces_of does.
  Echo echo(const Polygon& part, const PhysicalOptics& options) const;

 private:
  // The bases at both ends of the way by the middle of a part.
  struct Ends {
    device::wt_basis departure, arrival;
    double length_m;
  };
  glm::dvec3 departure(glm::dvec3 direction) const;
  device::wt_transfer arriving(glm::dvec3 direction, const device::wt_basis& departure) const;
  SlabCoefficients reflection(uint32_t facet, glm::dvec3 direction) const;
  device::wt_matrix piece(const Polygon& polygon, const Ends& ends) const;
  std::vector<glm::dvec3> way(glm::dvec3 point) const;
};

}  // namespace wavetracer
