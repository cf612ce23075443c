// SPDX-License-Identifier: Apache-2.0
// The directions of detections, by the elements of the arrays of a radar.
#pragma once
#include <complex>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "radar/beat_signal.hpp"
#include "wavetracer/frame_result.hpp"
#include "wavetracer/radar_config.hpp"

namespace wavetracer {

// Azimuth from ahead towards the left and elevation upwards, rad; NaN: the array cannot tell it.
struct ArrivalAngles {
  double azimuth_rad, elevation_rad;
};

// The places of a radar's antennas as elements that look to one direction, in the axes of the receiving antenna.
class LookingArray {
 public:
  // With a monostatic radar whose ends are at most 1 m apart, a wave goes to the target and back in one direction, so
  // pairs of elements are those of a virtual array. Else the elements of the receiver alone count, and the powers of
  // transmitting antennas add up.
  LookingArray(const Config& config, const FrameResult& frame, Link link, const RadarConfig& radar);

  // values: the cell of each pair of antennas, [rx antenna][tx antenna]. The direction from which the array receives
  // most power, ahead of it. With elements along one axis alone, the other angle is taken for 0, and is NaN.
  ArrivalAngles angles(const std::vector<std::complex<double>>& values) const;

 private:
  double power(const std::vector<std::complex<double>>& values, double left, double up) const;
  double refined(const std::vector<std::complex<double>>& values, double& left, double& up, double step) const;

  std::vector<glm::dvec3> sent_, heard_;  // elements, in turns of phase for each unit of a direction's components
  size_t tx_ports_, rx_ports_;
  bool together_;
  double width_ = 0, height_ = 0;  // extents along y and z, in wavelengths
};

}  // namespace wavetracer
