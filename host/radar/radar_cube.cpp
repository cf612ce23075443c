// SPDX-License-Identifier: Apache-2.0
// Transforms are those of Eigen, one row at a time; each thread has its own plans.
#include "radar/radar_cube.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "radio/constants.hpp"

namespace wavetracer {
namespace {

using CubeValue = std::complex<double>;
using Transform = Eigen::FFT<double>;

// A window whose sum is 1, so that a wave keeps its amplitude.
std::vector<double> window_of(RadarWindow name, size_t count) {
  const double a = name == "hann" ? 0.5 : name == "hamming" ? 0.54 : name == "blackman" ? 0.42 : 1;
  const double b = name == "hann" || name == "blackman" ? 0.5 : name == "hamming" ? 0.46 : 0;
  const double c = name == "blackman" ? 0.08 : 0;
  std::vector<double> out(count);
  double sum = 0;
  for (size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    out[i] = a - b * std::cos(angle) + c * std::cos(2 * angle);
    sum += out[i];
  }
  for (double& value : out) value /= sum;
  return out;
}

Transform unscaled() {
  Transform out;
  out.SetFlag(Transform::Unscaled);
  return out;
}

// Delays: the transform over the samples of each chirp.
std::vector<CubeValue> range_profiles(const BeatSignal& signal, RadarWindow name) {
  const std::vector<double> window = window_of(name, signal.samples);
  std::vector<CubeValue> out(signal.re.size());
  tbb::enumerable_thread_specific<Transform> plans(unscaled);
  tbb::parallel_for(size_t{0}, out.size() / signal.samples, [&](size_t row) {
    std::vector<CubeValue> in(signal.samples);
    const size_t first = row * signal.samples;
    for (size_t s = 0; s < signal.samples; ++s)
      in[s] = {signal.re[first + s] * window[s], signal.im[first + s] * window[s]};
    plans.local().inv(&out[first], in.data(), static_cast<Eigen::Index>(signal.samples));
  });
  return out;
}

}  // namespace

double radar_power_dbm(const RadarConfig& radar, const RadioConfig& radio) {
  return radar.power_dbm.value_or(radio.transmit_power_dbm.value_or(RadarConfig::default_power_dbm));
}

RadarAxes radar_axes(const RadarConfig& radar, uint32_t rx_antennas, uint32_t tx_antennas, double carrier_hz) {
  RadarAxes out{rx_antennas, tx_antennas, {}, {}, {}, {}};
  const double half_c = speed_of_light_m_s / 2, step_hz = 1 / (radar.chirps * radar.repetition_s(tx_antennas));
  for (uint32_t s = 0; s < radar.samples; ++s) {
    out.delay_s.push_back(s / radar.bandwidth_hz);
    out.range_m.push_back(out.delay_s.back() * half_c);
  }
  for (int64_t n = 0; n < radar.chirps; ++n) {
    out.doppler_hz.push_back(static_cast<double>(n - radar.chirps / 2) * step_hz);
    out.speed_m_s.push_back(out.doppler_hz.back() * (half_c / carrier_hz));
  }
  return out;
}

std::vector<CubeValue> radar_cube(const BeatSignal& signal, const RadarConfig& radar, const RadarAxes& axes) {
  std::vector<CubeValue> values = range_profiles(signal, radar.range_window);
  const std::vector<double> window = window_of(radar.doppler_window, signal.chirps);
  const size_t chirps = signal.chirps, samples = signal.samples, pairs = signal.rx_antennas * signal.tx_antennas;
  tbb::enumerable_thread_specific<Transform> plans(unscaled);
  tbb::parallel_for(size_t{0}, pairs * samples, [&](size_t column) {
    const size_t pair = column / samples, first = pair * chirps * samples + column % samples;
    std::vector<CubeValue> in(chirps), out(chirps);
    for (size_t n = 0; n < chirps; ++n) in[n] = values[first + n * samples] * window[n];
    plans.local().fwd(out.data(), in.data(), static_cast<Eigen::Index>(chirps));
    // An antenna that sends later sees a phase that has turned by then.
    const double later_s = radar.turns ? static_cast<double>(pair % signal.tx_antennas) * radar.spacing_s() : 0;
    for (size_t n = 0; n < chirps; ++n) {
      const size_t to = (n + chirps / 2) % chirps;  // negative shifts come first
      const double turns = later_s * axes.doppler_hz[to];
      const CubeValue back = std::polar(1.0, -2 * std::numbers::pi * (turns - std::floor(turns)));
      values[first + to * samples] = radar.turns ? out[n] * back : out[n];
    }
  });
  return values;
}

std::vector<double> radar_map_w(const std::vector<CubeValue>& cube, size_t pairs) {
  std::vector<double> out(cube.size() / pairs);
  for (size_t pair = 0; pair < pairs; ++pair)
    for (size_t i = 0; i < out.size(); ++i) out[i] += std::norm(cube[pair * out.size() + i]);
  for (double& power : out) power /= static_cast<double>(pairs);
  return out;
}

}  // namespace wavetracer
