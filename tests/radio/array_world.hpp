// SPDX-License-Identifier: Apache-2.0
// A world of one transmitter and one receiver that have arrays.
#pragma once
#include <complex>
#include <functional>

#include "radio/antenna.hpp"
#include "radio/world.hpp"
#include "wavetracer/arrays.hpp"

namespace wavetracer::test {

inline constexpr double carrier_hz = 5.9e9;
using Complex = std::complex<double>;

inline ArrayConfig panel(uint32_t rows, uint32_t columns, double spacing_wavelengths = 0.5) {
  ArrayConfig out;
  out.name = "panel";
  out.rows = rows;
  out.columns = columns;
  out.vertical_spacing_wavelengths = out.horizontal_spacing_wavelengths = spacing_wavelengths;
  return out;
}

// A world with one transmitter and one receiver, of these arrays.
struct ArrayWorld : World {
  ArrayWorld(const ArrayConfig& sent, const ArrayConfig& heard, const glm::dvec3& tx, const glm::dvec3& rx,
             const std::array<double, 3>& tx_orientation_deg = {0, 0, 0},
             const std::array<double, 3>& rx_orientation_deg = {0, 0, 0}) {
    config.arrays = {sent, heard};
    config.arrays[0].name = "sent";
    config.arrays[1].name = "heard";
    config.transmitters = {end(tx, "isotropic", "V", tx_orientation_deg)};
    config.receivers = {end(rx, "isotropic", "V", rx_orientation_deg)};
    config.transmitters[0].array = "sent";
    config.receivers[0].array = "heard";
  }

  FrameResult frame() const {
    FrameResult out;
    out.paths = compute_paths(scene, config, 0, geometry);
    const auto state = [](const RadioEnd& end) {
      return EndState{.position_m = {end.position_m[0], end.position_m[1], end.position_m[2]},
                      .rotation = rotation_of(end.orientation_deg)};
    };
    out.world.transmitters = {state(config.transmitters[0])};
    out.world.receivers = {state(config.receivers[0])};
    out.world.links = {{0, 0}};
    return out;
  }
  // Returns the position of an element in the scene.
  std::vector<glm::dvec3> elements(const RadioEnd& end) const {
    std::vector<glm::dvec3> out;
    for (const glm::dvec3& p : element_positions_m(config, end))
      out.push_back(glm::dvec3(end.position_m[0], end.position_m[1], end.position_m[2]) +
                    rotation_of(end.orientation_deg) * p);
    return out;
  }
};

}  // namespace wavetracer::test
