// The antenna of a radio end: an element pattern, one or two ports, turned into the global frame.
// Everything is per port: ports of one antenna share place and pattern and differ in polarisation.
#pragma once
#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <vector>

#include "radio/pattern.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

// Rotation from the antenna's frame to the global one: yaw about z, then pitch about the new y, then roll about the
// new x, in degrees (3GPP TR 38.901, eq. 7.1-2). A positive pitch turns the boresight +x down.
glm::dmat3 rotation_of(const std::array<double, 3>& orientation_deg);

using PortFields = std::array<FieldPair, 2>;

class Antenna {
 public:
  // slants_rad: one per port, the angle by which the pattern's field is turned about the direction of travel, from
  // theta-hat (V) towards phi-hat (H): the polarisation model of TR 38.901, eq. 7.3-4 and 7.3-5. The shape of the
  // pattern stays; to lay a dipole down, use the orientation.
  Antenna(Pattern pattern, const std::vector<double>& slants_rad, const glm::dmat3& rotation);

  uint32_t ports() const { return static_cast<uint32_t>(slants_.size()); }
  // That of its own orientation.
  const glm::dmat3& rotation() const { return to_global_; }

  // The field pattern of each port (0 for one that it does not have) in a global direction, of unit length and away
  // from the antenna, along the vectors of basis, which is basis_of(direction). Squared length: gain over isotropic. By
  // reciprocity it serves sending and receiving alike. rotation: from the antenna's axes to global ones.
  PortFields fields(const glm::dvec3& direction, const SphericalBasis& basis, const glm::dmat3& rotation) const;
  // That of one port, in the antenna's own orientation.
  FieldPair field(uint32_t port, const glm::dvec3& direction) const {
    return fields(direction, basis_of(direction), to_global_)[port];
  }

 private:
  struct Slant {
    double cosine, sine;
  };

  Pattern pattern_;
  bool isotropic_;             // the pattern does not look at its angles
  std::vector<Slant> slants_;  // one per port
  glm::dmat3 to_global_;
};

// Polarisations: "V"; "H"; "VH" (port 0 is V, port 1 is H); "cross" (port 0 is slanted by +45 degrees, port 1 by -45).
// Throws ConfigError if the antenna or the polarisation is unknown, InputError if the pattern file is malformed.
Antenna make_antenna(const RadioEnd& end);

}  // namespace wavetracer
