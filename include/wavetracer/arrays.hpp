// SPDX-License-Identifier: Apache-2.0
// Antenna arrays: the positions of an end's elements, and the path between every two elements of its ends. A path is
// solved once, between the centres of the arrays. Its length between two elements follows from its geometry: with
// radio.wavefront = "spherical" exactly, from the images of the elements in the mirrors of the path and from the edges
// and tiles between them; with "plane" to first order, from its directions at both ends. Elements are assumed to see
// the same sequences of surfaces as the centres. Fresnel coefficients, patterns and polarisations are those at the
// centres.
//
// An end has elements x ports antennas; antenna number i of an end is element i / ports, port i % ports. Matrices are
// row major: [receiver's ...][transmitter's ...].
#pragma once
#include <complex>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "wavetracer/config.hpp"
#include "wavetracer/frame_result.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

class Simulation;

// Returns the positions of an end's elements in the axes of its antenna (boresight +x), in metres from the position of
// the end; one element in the origin for an end without an array. Elements of a panel are in the plane x = 0, column by
// column: element column * rows + row; columns go towards +y, rows down from +z, as those of sionna.rt.PlanarArray.
// Throws ConfigError for an array that is not in the configuration.
std::vector<glm::dvec3> element_positions_m(const Config& config, const RadioEnd& end);

// Return the frequencies and times of [response]; both are empty if it is off. Frequencies are absolute: for each
// carrier in order, carrier + k bandwidth / subcarriers, with k from -floor(subcarriers / 2) on. Times are relative to
// that of the frame.
std::vector<double> response_frequencies_hz(const Config& config);
std::vector<double> response_times_s(const Config& config);

// One path between all pairs of elements, [rx element][tx element].
struct ElementPaths {
  uint32_t rx_elements = 1, tx_elements = 1;
  std::vector<double> delay_s;    // delay of the path between these elements
  std::vector<double> amplitude;  // spreading factor of the amplitude there, relative to that between the centres
};

class ElementModel {
 public:
  // config: with all ends of the world, as Simulation::config(). Keeps references to scene and models. Throws
  // ConfigError.
  ElementModel(const Config& config, const Scene& scene, std::span<const Scene> models = {},
               std::span<const Instance> instances = {});
  // Makes the model of a simulation, which must outlive it.
  explicit ElementModel(const Simulation& simulation);

  uint32_t tx_elements(uint32_t tx) const { return static_cast<uint32_t>(transmitters_.at(tx).positions_m.size()); }
  uint32_t rx_elements(uint32_t rx) const { return static_cast<uint32_t>(receivers_.at(rx).positions_m.size()); }
  uint32_t tx_ports(uint32_t tx) const { return transmitters_.at(tx).ports; }
  uint32_t rx_ports(uint32_t rx) const { return receivers_.at(rx).ports; }
  // Numbers of antennas: elements x ports.
  uint32_t tx_antennas(uint32_t tx) const { return tx_elements(tx) * tx_ports(tx); }
  uint32_t rx_antennas(uint32_t rx) const { return rx_elements(rx) * rx_ports(rx); }

  // Returns the carriers, radio.frequency_hz first.
  const std::vector<double>& carriers_hz() const { return carriers_hz_; }

  // row: index in frame.paths. Throws std::out_of_range if there is none.
  ElementPaths element_paths(const FrameResult& frame, size_t row) const;

  // Returns coefficients of a path between all pairs of antennas, [rx antenna][tx antenna]. Like Paths::a, they do not
  // include the carrier phase of the path's own delay_s, so h = sum coefficients exp(-j 2 pi f delay_s) at the carrier
  // f. carrier: 0 is radio.frequency_hz; others are those of radio.frequencies_hz.
  std::vector<std::complex<double>> coefficients(const FrameResult& frame, size_t row, uint32_t carrier = 0) const;

  // Returns the channel of a link, [time][rx antenna][tx antenna][frequency]:
  // h(f, t) = sum over its paths of a exp(-j 2 pi f delay) exp(j 2 pi doppler t), with the delays between elements.
  // frequencies_hz: absolute. times_s: relative to that of the frame. carrier: the carrier of these coefficients. All
  // values are 0 if the link has no path. It uses all cores; the result does not depend on their number.
  std::vector<std::complex<double>> response(const FrameResult& frame, Link link,
                                             std::span<const double> frequencies_hz, std::span<const double> times_s,
                                             uint32_t carrier = 0) const;

 private:
  struct End {
    std::vector<glm::dvec3> positions_m;  // positions of elements
    uint32_t ports = 1;
  };
  friend class ElementLink;

  const Scene& scene_;
  std::span<const Scene> models_;
  std::vector<Instance> instances_;
  std::vector<End> transmitters_, receivers_;
  std::vector<double> carriers_hz_;
  bool plane_ = false;  // wavefronts are plane
};

}  // namespace wavetracer
