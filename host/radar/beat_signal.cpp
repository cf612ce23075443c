// SPDX-License-Identifier: Apache-2.0
// Each chirp is the sum over all echoes in their order, on whichever core. Echoes come in blocks, so that their weights
// at all samples, which differ between the elements of arrays, take little memory.
#include "radar/beat_signal.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <span>

#include "radio/element_link.hpp"
#include "radio/unit_phases.hpp"
#include "radio/wide_loops.hpp"

namespace wavetracer {
namespace {

using Complex = std::complex<double>;

// A path as a radar sees it. Matrices are [rx antenna][tx antenna].
struct Echo {
  double delay_s, rate;         // between the centres of both ends, at the beginning of the frame; seconds per second
  std::vector<Complex> a;       // roots of watts, without the phase of delay_s at the carrier
  std::vector<double> later_s;  // by how much the path is longer between antennas; empty: there is one element each
};

// The times and frequencies of the samples of a chirp that is sent.
struct Ramp {
  double slope = 0;  // Hz / s
  std::vector<double> time_s, sent_hz, offset_hz;

  Ramp(const RadarConfig& radar, double carrier_hz) : slope(radar.bandwidth_hz / radar.chirp_s) {
    for (uint32_t s = 0; s < radar.samples; ++s) {
      time_s.push_back(s * (radar.chirp_s / radar.samples));
      sent_hz.push_back(carrier_hz - radar.bandwidth_hz / 2 + slope * time_s.back());
      offset_hz.push_back((static_cast<double>(s) / radar.samples - 0.5) * radar.bandwidth_hz);
    }
  }
};

Complex turned(double amplitude, double turns) {
  double re, im;
  unit_phases(&turns, 1, &re, &im);
  return {amplitude * re, amplitude * im};
}

Echo echo_of(const ElementLink& link, const FrameResult& frame, size_t row, double carrier_hz, double root_power) {
  const Paths& paths = frame.paths;
  const size_t rx = link.rx_elements(), tx = link.tx_elements(), columns = tx * link.tx_ports();
  Echo out{paths.delay_s[row],
           -paths.doppler_hz[row] / carrier_hz,
           std::vector<Complex>(rx * link.rx_ports() * columns),
           {}};
  if (rx * tx > 1) out.later_s.resize(out.a.size());
  const PathOfElements path = link.path(row);
  for (size_t r = 0; r < rx; ++r)
    for (size_t t = 0; t < tx; ++t) {
      const ElementPair pair = rx * tx > 1 ? path.between(r, t) : ElementPair{paths.delay_s[row], 1};
      const double later_s = pair.delay_s - paths.delay_s[row];
      const Complex moved = turned(pair.amplitude * root_power, carrier_hz * later_s);
      for (size_t p = 0; p < link.rx_ports(); ++p)
        for (size_t q = 0; q < link.tx_ports(); ++q) {
          const size_t at = (p * rx + r) * columns + q * tx + t;
          out.a[at] = paths.a[row][p * paths.tx_ports + q] * moved;
          if (rx * tx > 1) out.later_s[at] = later_s;
        }
    }
  return out;
}

// Adds weights times phases to a row of samples.
WAVETRACER_WIDE void add_weighted(const double* weight_re, const double* weight_im, const double* re, const double* im,
                                  size_t count, double* __restrict sum_re, double* __restrict sum_im) {
  for (size_t s = 0; s < count; ++s) {
    sum_re[s] += weight_re[s] * re[s] - weight_im[s] * im[s];
    sum_im[s] += weight_re[s] * im[s] + weight_im[s] * re[s];
  }
}

WAVETRACER_WIDE void add_constant(const Complex& weight, const double* re, const double* im, size_t count,
                                  double* __restrict sum_re, double* __restrict sum_im) {
  add_product(weight, re, im, count, sum_re, sum_im);
}

// The phases of an echo at the samples of a chirp that begins when its delay is delay_s.
WAVETRACER_WIDE void chirp_phases(const double* time_s, const double* sent_hz, double slope, double delay_s,
                                  double rate, size_t count, double* __restrict turns, double* re, double* im) {
  for (size_t s = 0; s < count; ++s) {
    const double tau = delay_s + rate * time_s[s];
    turns[s] = (sent_hz[s] - 0.5 * slope * tau) * tau;
  }
  unit_phases(turns, count, re, im);
}

// The weights of some echoes of arrays, [echo][rx antenna][tx antenna][sample].
struct Weights {
  std::vector<double> re, im;
};

Weights weights_of(std::span<const Echo> echoes, const Ramp& ramp) {
  Weights out;
  if (echoes.empty() || echoes[0].later_s.empty()) return out;
  const size_t pairs = echoes[0].a.size(), samples = ramp.time_s.size();
  out.re.resize(echoes.size() * pairs * samples);
  out.im.resize(out.re.size());
  tbb::parallel_for(size_t{0}, echoes.size() * pairs, [&](size_t i) {
    const Echo& echo = echoes[i / pairs];
    const Complex a = echo.a[i % pairs];
    std::vector<double> turns(samples);
    for (size_t s = 0; s < samples; ++s) turns[s] = echo.later_s[i % pairs] * ramp.offset_hz[s];
    double *const re = &out.re[i * samples], *const im = &out.im[i * samples];
    unit_phases(turns.data(), samples, re, im);
    for (size_t s = 0; s < samples; ++s) {
      const Complex w = Complex(re[s] * a.real() - im[s] * a.imag(), re[s] * a.imag() + im[s] * a.real());
      re[s] = w.real();
      im[s] = w.imag();
    }
  });
  return out;
}

// Adds some echoes to all chirps.
void add_echoes(std::span<const Echo> echoes, const Ramp& ramp, const RadarConfig& radar, BeatSignal& out) {
  const Weights weights = weights_of(echoes, ramp);
  const size_t samples = out.samples, turns = radar.turns ? out.tx_antennas : 1,
               pairs = out.rx_antennas * out.tx_antennas;
  tbb::parallel_for(size_t{0}, out.chirps * turns, [&](size_t task) {
    const size_t chirp = task / turns, turn = task % turns;
    const double begin_s = static_cast<double>(turn) * radar.spacing_s() +
                           static_cast<double>(chirp) * radar.repetition_s(static_cast<uint32_t>(out.tx_antennas));
    const size_t first = radar.turns ? turn : 0, end = radar.turns ? turn + 1 : out.tx_antennas;
    std::vector<double> scratch(3 * samples);
    double *const cycles = scratch.data(), *const re = cycles + samples, *const im = re + samples;
    for (size_t e = 0; e < echoes.size(); ++e) {
      const Echo& echo = echoes[e];
      chirp_phases(ramp.time_s.data(), ramp.sent_hz.data(), ramp.slope, echo.delay_s + echo.rate * begin_s, echo.rate,
                   samples, cycles, re, im);
      for (size_t r = 0; r < out.rx_antennas; ++r)
        for (size_t t = first; t < end; ++t) {
          const size_t pair = r * out.tx_antennas + t, at = out.row(r, t, chirp);
          if (echo.later_s.empty()) {
            add_constant(echo.a[pair], re, im, samples, &out.re[at], &out.im[at]);
          } else {
            const size_t w = (e * pairs + pair) * samples;
            add_weighted(&weights.re[w], &weights.im[w], re, im, samples, &out.re[at], &out.im[at]);
          }
        }
    }
  });
}

}  // namespace

BeatSignal beat_signal(const ElementModel& model, const FrameResult& frame, Link link, const RadarConfig& radar,
                       double power_dbm) {
  constexpr size_t weights_at_once = size_t{1} << 20;
  const double carrier_hz = model.carriers_hz()[0], root_power = std::sqrt(1e-3 * std::pow(10, power_dbm / 10));
  const ElementLink elements(model, frame, link);
  BeatSignal out{model.rx_antennas(link.rx), model.tx_antennas(link.tx), radar.chirps, radar.samples, {}, {}};
  out.re.resize(out.rx_antennas * out.tx_antennas * out.chirps * out.samples);
  out.im.resize(out.re.size());
  std::vector<size_t> rows;
  for (size_t row = elements.first_row(); row < elements.end_row(); ++row) {
    if (!radar.direct && frame.paths.depth[row] == 0) continue;
    if (frame.paths.delay_s[row] < radar.longest_delay_s())
      rows.push_back(row);
    else
      ++out.left_out;
  }
  const Ramp ramp(radar, carrier_hz);
  const size_t step = std::max<size_t>(1, weights_at_once / (out.rx_antennas * out.tx_antennas * out.samples));
  for (size_t first = 0; first < rows.size(); first += step) {
    std::vector<Echo> echoes(std::min(step, rows.size() - first));
    tbb::parallel_for(size_t{0}, echoes.size(),
                      [&](size_t i) { echoes[i] = echo_of(elements, frame, rows[first + i], carrier_hz, root_power); });
    add_echoes(echoes, ramp, radar, out);
  }
  return out;
}

}  // namespace wavetracer
