// SPDX-License-Identifier: Apache-2.0
// Coefficients and responses between elements are computed pair by pair, so every sum is made in the order of the
// paths, on whichever core.
#include "radio/element_responses.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "radio/carriers.hpp"
#include "radio/element_link.hpp"
#include "radio/response_sum.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using Complex = std::complex<double>;
using PortMatrix = std::array<Complex, 4>;

// The coefficients of paths at a carrier, and the factor of Doppler shifts there.
struct CarrierRows {
  const std::vector<PortMatrix>& a;
  double doppler_scale;
};

CarrierRows rows_at(const FrameResult& frame, std::span<const double> carriers_hz, uint32_t carrier) {
  if (carrier == 0) return {frame.paths.a, 1};
  return {frame.carriers.at(carrier - 1).a, carriers_hz[carrier] / carriers_hz[0]};
}

// The data of one path that a link's response needs.
struct ResponsePath {
  PathOfElements elements;
  std::vector<Complex> a;  // (time, rx port, tx port), turned by the Doppler shift
};

std::vector<ResponsePath> paths_of(const ElementLink& link, const FrameResult& frame, const CarrierRows& rows,
                                   std::span<const double> times_s) {
  std::vector<ResponsePath> out(link.end_row() - link.first_row());
  tbb::parallel_for(size_t{0}, out.size(), [&](size_t i) {
    const size_t row = link.first_row() + i;
    out[i].elements = link.path(row);
    for (const double time_s : times_s) {
      const double turns = frame.paths.doppler_hz[row] * rows.doppler_scale * time_s;
      const Complex moved = std::polar(1.0, 2 * std::numbers::pi * (turns - std::floor(turns)));
      for (uint32_t p = 0; p < link.rx_ports(); ++p)
        for (uint32_t q = 0; q < link.tx_ports(); ++q)
          out[i].a.push_back(rows.a.at(row)[p * frame.paths.tx_ports + q] * moved);
    }
  });
  return out;
}

// Computes blocks of pairs: one receiving element and some transmitting ones. out(time, rx antenna, tx antenna,
// frequency, value) takes each result.
template <class Out>
void respond(const ElementLink& link, const FrameResult& frame, const CarrierRows& rows, const FrequencyAxis& axis,
             std::span<const double> times_s, const Out& out) {
  const std::vector<ResponsePath> paths = paths_of(link, frame, rows, times_s);
  const size_t rx_ports = link.rx_ports(), tx_ports = link.tx_ports(),
               coefficients = times_s.size() * rx_ports * tx_ports;
  const size_t at_once = ResponseSum::pairs_at_once(axis, coefficients),
               blocks = (link.tx_elements() + at_once - 1) / at_once;
  tbb::parallel_for(size_t{0}, blocks * link.rx_elements(), [&](size_t block) {
    const size_t r = block / blocks, first = block % blocks * at_once;
    const size_t count = std::min(at_once, link.tx_elements() - first);
    std::array<double, ResponseSum::most_pairs> delay_s, amplitude;
    ResponseSum sum(axis, coefficients);
    for (const ResponsePath& path : paths) {
      path.elements.between(r, first, count, delay_s.data(), amplitude.data());
      sum.add(delay_s.data(), amplitude.data(), count, path.a);
    }
    for (size_t c = 0; c < coefficients; ++c)
      for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < axis.frequencies_hz.size(); ++k)
          out(c / (rx_ports * tx_ports), r * rx_ports + c / tx_ports % rx_ports, (first + i) * tx_ports + c % tx_ports,
              k, sum.value(c, i, k));
  });
}

constexpr uint64_t most_response_bytes = uint64_t{1} << 35;  // the most of a frame

// The rows of each link, still empty.
Responses empty_responses(const ElementModel& model, const FrameResult& frame, size_t times, size_t frequencies) {
  Responses out{static_cast<uint32_t>(times), static_cast<uint32_t>(frequencies), {0}, {}};
  for (const Link& link : frame.world.links)
    out.row_offset.push_back(out.row_offset.back() +
                             times * model.rx_antennas(link.rx) * uint64_t{model.tx_antennas(link.tx)});
  const uint64_t row_bytes = frequencies * sizeof out.h[0];
  if (out.row_offset.back() > most_response_bytes / row_bytes)
    throw RuntimeError(fmt::format(
        "the responses of frame {} have {} rows (time, receiving antenna, transmitting antenna) of {} frequencies, "
        "more than {} GiB: lower response.subcarriers, response.times or the number of links (links.max_distance_m)",
        frame.frame, out.row_offset.back(), frequencies, most_response_bytes >> 30));
  out.h.resize(out.row_offset.back() * frequencies);
  return out;
}

}  // namespace

ElementPaths ElementModel::element_paths(const FrameResult& frame, size_t row) const {
  const ElementLink link(*this, frame, {frame.paths.tx.at(row), frame.paths.rx.at(row)});
  const PathOfElements path = link.path(row);
  ElementPaths out{link.rx_elements(), link.tx_elements(), {}, {}};
  for (size_t r = 0; r < link.rx_elements(); ++r)
    for (size_t t = 0; t < link.tx_elements(); ++t) {
      const ElementPair pair = path.between(r, t);
      out.delay_s.push_back(pair.delay_s);
      out.amplitude.push_back(pair.amplitude);
    }
  return out;
}

std::vector<Complex> ElementModel::coefficients(const FrameResult& frame, size_t row, uint32_t carrier) const {
  const ElementPaths pairs = element_paths(frame, row);
  const uint32_t rx_ports = this->rx_ports(frame.paths.rx[row]), tx_ports = this->tx_ports(frame.paths.tx[row]);
  const PortMatrix& a = rows_at(frame, carriers_hz_, carrier).a.at(row);
  const size_t columns = size_t{pairs.tx_elements} * tx_ports;
  std::vector<Complex> out(size_t{pairs.rx_elements} * rx_ports * columns);
  for (size_t pair = 0; pair < pairs.delay_s.size(); ++pair) {
    const double turns = carriers_hz_.at(carrier) * (pairs.delay_s[pair] - frame.paths.delay_s[row]);
    const Complex moved = std::polar(pairs.amplitude[pair], -2 * std::numbers::pi * (turns - std::floor(turns)));
    const size_t r = pair / pairs.tx_elements * rx_ports, t = pair % pairs.tx_elements * tx_ports;
    for (uint32_t p = 0; p < rx_ports; ++p)
      for (uint32_t q = 0; q < tx_ports; ++q) out[(r + p) * columns + t + q] = a[p * frame.paths.tx_ports + q] * moved;
  }
  return out;
}

std::vector<Complex> ElementModel::response(const FrameResult& frame, Link link, std::span<const double> frequencies_hz,
                                            std::span<const double> times_s, uint32_t carrier) const {
  const ElementLink elements(*this, frame, link);
  const size_t rx = rx_antennas(link.rx), tx = tx_antennas(link.tx), count = frequencies_hz.size();
  std::vector<Complex> out(times_s.size() * rx * tx * count);
  respond(elements, frame, rows_at(frame, carriers_hz_, carrier), FrequencyAxis(frequencies_hz), times_s,
          [&](size_t time, size_t r, size_t t, size_t k, const Complex& h) {
            out[((time * rx + r) * tx + t) * count + k] = h;
          });
  return out;
}

Responses make_responses(const ElementModel& model, const Config& config, const FrameResult& frame) {
  const std::vector<double> frequencies_hz = response_frequencies_hz(config), times_s = response_times_s(config),
                            carriers = carriers_hz(config.radio);
  if (frequencies_hz.empty()) return {};
  Responses out = empty_responses(model, frame, times_s.size(), frequencies_hz.size());
  const size_t subcarriers = frequencies_hz.size() / carriers.size();
  tbb::parallel_for(size_t{0}, frame.world.links.size(), [&](size_t i) {
    const Link link = frame.world.links[i];
    const ElementLink elements(model, frame, link);
    const size_t rx = model.rx_antennas(link.rx), tx = model.tx_antennas(link.tx);
    for (uint32_t carrier = 0; carrier < carriers.size(); ++carrier) {
      const std::span<const double> of_carrier(frequencies_hz.data() + carrier * subcarriers, subcarriers);
      const FrequencyAxis axis(of_carrier);
      std::complex<float>* const h = out.h.data() + out.row_offset[i] * frequencies_hz.size() + carrier * subcarriers;
      respond(elements, frame, rows_at(frame, carriers, carrier), axis, times_s,
              [&](size_t time, size_t r, size_t t, size_t k, const Complex& value) {
                h[((time * rx + r) * tx + t) * frequencies_hz.size() + k] = std::complex<float>(value);
              });
    }
  });
  return out;
}

}  // namespace wavetracer
