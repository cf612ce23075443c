// From exact path geometry to propagation paths: delays, angles and coefficients, in double on the host.
// Each row depends on its own path alone, so results do not depend on device, thread count or order of discovery.
#pragma once
#include <complex>
#include <span>
#include <string>
#include <vector>

#include "radio/antenna.hpp"
#include "radio/interactions.hpp"
#include "radio/legs.hpp"
#include "radio/near_ends.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/path_geometry.hpp"
#include "wavetracer/paths.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// What fields need to know about a world and its radio ends; made once, then used for every frame.
// Keeps references to the scene and the models.
class FieldModel {
 public:
  // config: its transmitters and receivers are all of the world's. Throws ConfigError or InputError for an antenna that
  // cannot be made, and ConfigError for a material that some surface uses and that is not known at radio.frequency_hz.
  FieldModel(const Scene& scene, const Config& config, std::span<const Scene> models = {},
             std::span<const Instance> instances = {});

  // geometry: interactions as class Interactions knows them, in any order of rows, in the recentred frame of the scene,
  // its surfaces and wedges numbered through the world. Rows of the result are sorted by tx, rx, delay, surfaces (the
  // world's numbers), interactions and vertices.
  //   a[r tx_ports + t]: rx port r, tx port t; lambda / (4 pi) times both antennas' fields, every interaction and the
  //     spreading, which is 1 / L where nothing diffracts or scatters.
  //     Ports that an antenna does not have are 0.
  //   aod: the direction in which the wave leaves tx; aoa: from rx towards where the wave comes from.
  //   doppler_hz: -1/lambda times the rate at which the path gets longer, from the velocities of its ends and of the
  //     surfaces and edges that turn it.
  //   gain_db: over all pairs of ports, -inf if an antenna is blind in that direction.
  //   vertex_surface: its number in the static scene, or in the model of the instance in vertex_instance.
  // Paths of near ends are left out (radio/near_ends.hpp) and counted in left_out. Throws RuntimeError for another
  // interaction.
  Paths compute(uint32_t frame, PathGeometry geometry, const WorldState& state, LeftOut* left_out = nullptr) const;
  // The same with every end where the configuration has it, and no instances.
  Paths compute(uint32_t frame, PathGeometry geometry) const { return compute(frame, std::move(geometry), still_); }

 private:
  // Writes row `row` of the result.
  void evaluate(const PathGeometry& geometry, size_t path, const WorldState& state, const Legs& legs,
                const SiblingQuestion& sibling, Paths& paths, size_t row) const;

  Interactions interactions_;
  glm::dvec3 origin_m_;
  std::vector<Antenna> transmitters_, receivers_;
  uint32_t tx_ports_, rx_ports_;  // the most that any end of that side has
  WorldState still_;
};

// The same for a single frame of a world in which no surface moves.
Paths compute_paths(const Scene& scene, const Config& config, uint32_t frame, const PathGeometry& geometry);

}  // namespace wavetracer
