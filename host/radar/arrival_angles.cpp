// SPDX-License-Identifier: Apache-2.0
// A search over a grid of directions that is finer than a beam, then steps that become smaller about the best of them.
// Directions are given by their components to the left (y) and upwards (z).
#include "radar/arrival_angles.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "radio/constants.hpp"

namespace wavetracer {
namespace {

constexpr double least_extent = 1e-3;  // wavelengths: less tells no direction
constexpr double most_apart_m = 1;     // ends further apart see an echo in different directions

double extent_of(const std::vector<glm::dvec3>& elements, glm::length_t axis) {
  const auto [low, high] = std::ranges::minmax(elements, {}, [&](const glm::dvec3& p) { return p[axis]; });
  return high[axis] - low[axis];
}

// The number of steps from -1 to 1 that are a third of a beam.
int64_t grid_steps(double extent) {
  return extent > least_extent ? std::clamp<int64_t>(static_cast<int64_t>(std::ceil(6 * extent)), 8, 512) : 0;
}

}  // namespace

LookingArray::LookingArray(const Config& config, const FrameResult& frame, Link link, const RadarConfig& radar)
    : tx_ports_(ports_of(config.transmitters[link.tx].polarization)),
      rx_ports_(ports_of(config.receivers[link.rx].polarization)),
      together_(radar.kind == "monostatic" &&
                glm::distance(frame.world.receivers[link.rx].position_m,
                              frame.world.transmitters[link.tx].position_m) <= most_apart_m) {
  const double wavelength_m = speed_of_light_m_s / config.radio.frequency_hz;
  const glm::dmat3 axes = glm::transpose(frame.world.receivers[link.rx].rotation) *
                          frame.world.transmitters[link.tx].rotation;  // from the transmitter's to the receiver's
  for (const glm::dvec3& p : element_positions_m(config, config.receivers[link.rx])) heard_.push_back(p / wavelength_m);
  for (const glm::dvec3& p : element_positions_m(config, config.transmitters[link.tx]))
    sent_.push_back(axes * p / wavelength_m);
  const auto extent = [&](glm::length_t axis) {
    return extent_of(heard_, axis) + (together_ ? extent_of(sent_, axis) : 0);
  };
  width_ = extent(1);
  height_ = extent(2);
}

double LookingArray::power(const std::vector<std::complex<double>>& values, double left, double up) const {
  const double ahead_square = 1 - left * left - up * up;
  if (ahead_square < 0) return -1;
  const glm::dvec3 look(std::sqrt(ahead_square), left, up);
  const auto steering = [&](const glm::dvec3& element) {
    return std::polar(1.0, -2 * std::numbers::pi * glm::dot(look, element));
  };
  std::vector<std::complex<double>> sent, heard;
  for (const glm::dvec3& element : sent_) sent.push_back(together_ ? steering(element) : 1.0);
  for (const glm::dvec3& element : heard_) heard.push_back(steering(element));
  const size_t tx = sent.size(), rx = heard.size(), columns = tx * tx_ports_;
  double out = 0;
  for (size_t p = 0; p < rx_ports_; ++p)
    for (size_t q = 0; q < tx_ports_; ++q) {
      std::complex<double> all = 0;
      for (size_t t = 0; t < tx; ++t) {
        std::complex<double> of_sender = 0;
        for (size_t r = 0; r < rx; ++r) of_sender += heard[r] * values[(p * rx + r) * columns + q * tx + t];
        if (together_)
          all += sent[t] * of_sender;
        else
          out += std::norm(of_sender);
      }
      out += std::norm(all);
    }
  return out;
}

// Steps to the best of the directions around, and halves the step where there is none.
double LookingArray::refined(const std::vector<std::complex<double>>& values, double& left, double& up,
                             double step) const {
  double best = power(values, left, up);
  while (step > 1e-7) {
    const double from_left = left, from_up = up;
    for (const auto& [by_left, by_up] : {std::pair(-step, 0.0), {step, 0.0}, {0.0, -step}, {0.0, step}}) {
      if ((by_left != 0 && width_ <= least_extent) || (by_up != 0 && height_ <= least_extent)) continue;
      const double here = power(values, from_left + by_left, from_up + by_up);
      if (here <= best) continue;
      best = here;
      left = from_left + by_left;
      up = from_up + by_up;
    }
    if (left == from_left && up == from_up) step /= 2;
  }
  return best;
}

ArrivalAngles LookingArray::angles(const std::vector<std::complex<double>>& values) const {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const int64_t across = grid_steps(width_), along = grid_steps(height_);
  if (across == 0 && along == 0) return {none, none};
  double left = 0, up = 0, best = -1;
  for (int64_t i = 0; i <= across; ++i)
    for (int64_t k = 0; k <= along; ++k) {
      const double y = across > 0 ? 2.0 * static_cast<double>(i) / static_cast<double>(across) - 1 : 0;
      const double z = along > 0 ? 2.0 * static_cast<double>(k) / static_cast<double>(along) - 1 : 0;
      if (const double here = power(values, y, z); here > best) {
        best = here;
        left = y;
        up = z;
      }
    }
  refined(values, left, up, 1.0 / static_cast<double>(std::max(across, along)));
  const double ahead = std::sqrt(std::max(0.0, 1 - left * left - up * up));
  return {across > 0 ? std::atan2(left, ahead) : none, along > 0 ? std::asin(std::clamp(up, -1.0, 1.0)) : none};
}

}  // namespace wavetracer
