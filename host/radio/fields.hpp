// From exact path geometry to propagation paths: delays, angles and coefficients, in double on the host.
// Each row depends on its own path alone, so results do not depend on device, thread count or order of discovery.
#pragma once
#include <complex>
#include <string>
#include <vector>

#include "radio/antenna.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/path_geometry.hpp"
#include "wavetracer/paths.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// What fields need to know about a scene and its radio ends; made once, then used for every frame.
// Keeps a reference to the scene.
class FieldModel {
 public:
  // Throws ConfigError or InputError for an antenna that cannot be made, and ConfigError for a material that some
  // surface uses and that is not known at radio.frequency_hz.
  FieldModel(const Scene& scene, const Config& config);

  // geometry: specular reflections and straight transmissions, in any order of rows, in the recentred frame of the
  // scene. Rows of the result are sorted by tx, rx, delay, surfaces, interactions and vertices.
  //   a[r tx_ports + t]: rx port r, tx port t; lambda / (4 pi L) times both antennas' fields and every interaction.
  //     Ports that an antenna does not have are 0.
  //   aod: the direction in which the wave leaves tx; aoa: from rx towards where the wave comes from.
  //   doppler_hz: -1/lambda times the rate at which the path gets longer, from the velocities of its ends. Surfaces
  //     stand still, and by Fermat's principle the points on them need not be followed.
  //   gain_db: over all pairs of ports, -inf if an antenna is blind in that direction.
  // Throws RuntimeError for another interaction and for ends that stand in the same point.
  Paths compute(uint32_t frame, const PathGeometry& geometry) const;

 private:
  struct End {
    std::string name;
    glm::dvec3 position;  // recentred
    glm::dvec3 velocity;  // m/s
    Antenna antenna;
  };
  struct Row;

  Row solve(const PathGeometry& geometry, size_t path) const;

  const Scene& scene_;
  double wavelength_m_;
  std::vector<std::complex<double>> permittivity_;  // one a material; 0 where no surface uses it
  std::vector<End> transmitters_, receivers_;
  uint32_t tx_ports_, rx_ports_;  // the most that any end of that side has
};

// The same for a single frame.
Paths compute_paths(const Scene& scene, const Config& config, uint32_t frame, const PathGeometry& geometry);

}  // namespace wavetracer
