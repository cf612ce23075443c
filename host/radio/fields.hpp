// SPDX-License-Identifier: Apache-2.0
// From exact path geometry to propagation paths: delays, angles and coefficients, in double on the host. The code is
// the same as on devices (wavetracer/device/path_field.h), row by row. It is the reference that devices are tested
// against, and it evaluates paths that come from elsewhere. Results do not depend on the number of threads.
#pragma once
#include <functional>
#include <map>
#include <string>

#include "radio/field_tables.hpp"
#include "wavetracer/path_geometry.hpp"
#include "wavetracer/paths.hpp"

namespace wavetracer {

// The number of a link's paths that were left out, because an antenna touches a surface or another antenna. An end that
// is at most WT_ON_SURFACE_M from the plane of a surface is on it, and the surface is no mirror next to that end; ends
// that are at most this far from each other have no line of sight. Both ends of a path are treated alike, so that
// channels are reciprocal.
using LeftOut = std::map<Link, uint32_t>;

// Keeps references to the scene and the models.
class FieldModel {
 public:
  // It takes the arguments of make_field_tables.
  FieldModel(const Scene& scene, const Config& config, std::span<const Scene> models = {},
             std::span<const Instance> instances = {});

  // geometry: in any order of rows, in the recentred frame of the scene; surfaces, wedges and tiles have their numbers
  // in the world. Rows of the result are sorted by tx, rx, delay, surfaces (the world's numbers), interactions and
  // vertices.
  //   a[r tx_ports + t]: rx port r, tx port t; lambda / (4 pi) times both antennas' fields, every interaction and the
  //     spreading, which is 1 / L where nothing diffracts or scatters.
  //     Ports that an antenna does not have are 0.
  //   aod: the direction in which the wave leaves tx; aoa: from rx towards where the wave comes from.
  //   doppler_hz: -1/lambda times the rate at which the path gets longer, from the velocities of its ends and of the
  //     surfaces and edges that turn it.
  //   gain_db: over all pairs of ports, -inf if an antenna is blind in that direction.
  //   vertex_surface: its number in the static scene, or in the model of the instance in vertex_instance.
  // Throws RuntimeError for an interaction of no known kind.
  Paths compute(uint32_t frame, const PathGeometry& geometry, const WorldState& state,
                LeftOut* left_out = nullptr) const;
  // The same with every end at its place in the configuration, and no instances.
  Paths compute(uint32_t frame, const PathGeometry& geometry) const { return compute(frame, geometry, still_); }

 private:
  const Scene& scene_;
  std::span<const Scene> models_;
  std::vector<Instance> instances_;
  FieldTables tables_;
  WorldState still_;
};

// The same for a single frame of a world in which no surface moves.
Paths compute_paths(const Scene& scene, const Config& config, uint32_t frame, const PathGeometry& geometry);

// The text of a warning about the paths that were left out; left_out is not empty.
using EndName = std::function<std::string(uint32_t end)>;
std::string left_out_warning(const LeftOut& left_out, const EndName& tx_name, const EndName& rx_name);

}  // namespace wavetracer
