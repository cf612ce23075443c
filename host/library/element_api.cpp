// SPDX-License-Identifier: Apache-2.0
// The functions of wavetracer.h about the elements of arrays.
#include <algorithm>
#include <span>
#include "library/handles.hpp"
#include "wavetracer/arrays.hpp"

namespace wavetracer::c_api {
namespace {

size_t elements_of(const Config& config, const std::vector<RadioEnd>& ends, size_t index) {
  if (index >= ends.size()) return 0;
  try {
    return element_positions_m(config, ends[index]).size();
  } catch (...) {
    return 0;
  }
}

void check_room(const char* function, size_t room, size_t wanted) {
  if (room < wanted)
    throw ConfigError(std::string(function) + ": there is room for " + std::to_string(room) + " values, but " +
                      std::to_string(wanted) + " are needed");
}

void copy_positions(const char* function, const Config& config, const std::vector<RadioEnd>& ends, size_t index,
                    double* to, size_t count) {
  if (index >= ends.size())
    throw ConfigError(std::string(function) + ": there is no end " + std::to_string(index) + ", only " +
                      std::to_string(ends.size()) + " counted from 0");
  const std::vector<glm::dvec3> positions_m = element_positions_m(config, ends[index]);
  check_room(function, count, 3 * positions_m.size());
  for (const glm::dvec3& p : positions_m)
    for (int axis = 0; axis < 3; ++axis) *to++ = p[axis];
}

// Returns the element model of a frame and its carrier, after the checks that the functions about paths share.
ElementModel model_of(const char* function, const wavetracer_simulation& self, const wavetracer_frame& frame,
                      uint32_t carrier) {
  check_owner(function, self, frame);
  const size_t carriers = 1 + frame.result.carriers.size();
  if (carrier >= carriers)
    throw ConfigError(std::string(function) + ": there is no carrier " + std::to_string(carrier) + ", only " +
                      std::to_string(carriers) + " counted from 0");
  return ElementModel(self.simulation);
}

void copy_values(const char* function, const std::vector<std::complex<double>>& values, double* to, size_t count) {
  check_room(function, count, values.size());
  for (const std::complex<double>& value : values) {
    *to++ = value.real();
    *to++ = value.imag();
  }
}

// Refuses larger numbers, whose phases would have no digits left, and NaN.
void check_numbers(const char* here, const char* name, std::span<const double> values, double least, double most) {
  for (size_t i = 0; i < values.size(); ++i)
    if (!(values[i] >= least && values[i] <= most))
      throw ConfigError(std::string(here) + ": " + name + "[" + std::to_string(i) + "] is " +
                        std::to_string(values[i]) + ", which is no number from " + std::to_string(least) + " to " +
                        std::to_string(most));
}

}  // namespace
}  // namespace wavetracer::c_api

using namespace wavetracer::c_api;
using wavetracer::ConfigError;

extern "C" {

size_t wavetracer_transmitter_elements(const wavetracer_simulation* self, size_t index) {
  return self ? elements_of(self->simulation.config(), self->simulation.config().transmitters, index) : 0;
}
size_t wavetracer_receiver_elements(const wavetracer_simulation* self, size_t index) {
  return self ? elements_of(self->simulation.config(), self->simulation.config().receivers, index) : 0;
}

int wavetracer_transmitter_element_positions(const wavetracer_simulation* self, size_t index, double* positions_m,
                                             size_t count, wavetracer_error** error) {
  return guarded(error, 0, [&] {
    const char* const here = "wavetracer_transmitter_element_positions";
    const wavetracer::Config& config = needed(self, here, "self").simulation.config();
    copy_positions(here, config, config.transmitters, index, &needed(positions_m, here, "positions_m"), count);
    return 1;
  });
}

int wavetracer_receiver_element_positions(const wavetracer_simulation* self, size_t index, double* positions_m,
                                          size_t count, wavetracer_error** error) {
  return guarded(error, 0, [&] {
    const char* const here = "wavetracer_receiver_element_positions";
    const wavetracer::Config& config = needed(self, here, "self").simulation.config();
    copy_positions(here, config, config.receivers, index, &needed(positions_m, here, "positions_m"), count);
    return 1;
  });
}

int wavetracer_element_coefficients(const wavetracer_simulation* self, const wavetracer_frame* frame, size_t row,
                                    uint32_t carrier, double* coefficients, size_t count, wavetracer_error** error) {
  return guarded(error, 0, [&] {
    const char* const here = "wavetracer_element_coefficients";
    const wavetracer_frame& of = needed(frame, here, "frame");
    const auto model = model_of(here, needed(self, here, "self"), of, carrier);
    check_row(here, of, row);
    copy_values(here, model.coefficients(of.result, row, carrier), &needed(coefficients, here, "coefficients"), count);
    return 1;
  });
}

int wavetracer_element_paths(const wavetracer_simulation* self, const wavetracer_frame* frame, const size_t* rows,
                             size_t row_count, size_t rx_elements, size_t tx_elements, double* delay_s,
                             double* amplitude, wavetracer_error** error) {
  return guarded(error, 0, [&] {
    const char* const here = "wavetracer_element_paths";
    const wavetracer_frame& of = needed(frame, here, "frame");
    const auto model = model_of(here, needed(self, here, "self"), of, 0);
    if (row_count == 0) return 1;
    needed(rows, here, "rows"), needed(delay_s, here, "delay_s"), needed(amplitude, here, "amplitude");
    for (size_t i = 0; i < row_count; ++i) {
      check_row(here, of, rows[i]);
      const wavetracer::ElementPaths pairs = model.element_paths(of.result, rows[i]);
      check_room(here, rx_elements, pairs.rx_elements);
      check_room(here, tx_elements, pairs.tx_elements);
      for (size_t r = 0; r < rx_elements; ++r)
        for (size_t t = 0; t < tx_elements; ++t) {
          const bool there = r < pairs.rx_elements && t < pairs.tx_elements;
          const size_t from = r * pairs.tx_elements + t, to = (i * rx_elements + r) * tx_elements + t;
          delay_s[to] = there ? pairs.delay_s[from] : of.result.paths.delay_s[rows[i]];
          amplitude[to] = there ? pairs.amplitude[from] : 0;
        }
    }
    return 1;
  });
}

int wavetracer_response(const wavetracer_simulation* self, const wavetracer_frame* frame, uint32_t tx, uint32_t rx,
                        uint32_t carrier, const double* frequencies_hz, size_t frequency_count, const double* times_s,
                        size_t time_count, double* h, size_t count, wavetracer_error** error) {
  return guarded(error, 0, [&] {
    const char* const here = "wavetracer_response";
    const wavetracer_frame& of = needed(frame, here, "frame");
    const auto model = model_of(here, needed(self, here, "self"), of, carrier);
    if (tx >= of.result.world.transmitters.size() || rx >= of.result.world.receivers.size())
      throw ConfigError(std::string(here) + ": there is no link from transmitter " + std::to_string(tx) +
                        " to receiver " + std::to_string(rx));
    check_room(here, count, frequency_count * time_count * model.rx_antennas(rx) * model.tx_antennas(tx));
    check_numbers(here, "frequencies_hz", {&needed(frequencies_hz, here, "frequencies_hz"), frequency_count}, 0, 1e13);
    check_numbers(here, "times_s", {&needed(times_s, here, "times_s"), time_count}, -1e12, 1e12);
    copy_values(here,
                model.response(of.result, {tx, rx}, {&needed(frequencies_hz, here, "frequencies_hz"), frequency_count},
                               {&needed(times_s, here, "times_s"), time_count}, carrier),
                &needed(h, here, "h"), count);
    return 1;
  });
}

}  // extern "C"
