// SPDX-License-Identifier: Apache-2.0
// What both faces of a slab reflect has a phase between them of 4 pi n d / wavelength, so a change of n d by half of a
// wavelength is one oscillation. In a Latin hypercube of N samples of a normal number neighbours are apart by 7.7 / N
// standard deviations where it is one and a half deviations from its mean. So with N = 20 times the oscillations of
// four deviations a sample is within a twentieth of an oscillation of the truth there, where the misfit is a third of
// what it is elsewhere.
#include "calibration/prior_samples.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "radio/constants.hpp"

namespace wavetracer::calibration {
namespace {

constexpr size_t samples_of_parameter = 8;
constexpr double samples_of_oscillation = 20, deviations = 2;
constexpr double least_echo = 0.05;  // of the amplitude that crosses a slab twice

std::complex<double> index_of(const device::wt_material& record) {
  return std::sqrt(std::complex<double>(record.permittivity[0], record.permittivity[1]));
}

// The number of oscillations as one property of a record grows.
double oscillations_of(const NamedRecords& world, const Parameter& parameter, uint32_t number) {
  const double wavelength_m = speed_of_light_m_s / world.frequency_hz;
  const auto record_at = [&](double theta) {
    const Parameter alone{.owner = parameter.owner,
                          .property = parameter.property,
                          .start = parameter.start,
                          .prior = parameter.prior,
                          .records = {number}};
    return with_parameters(world, std::span(&alone, 1), std::span(&theta, 1))[number];
  };
  const auto echo = [&](const device::wt_material& record) {
    return std::exp(-4 * std::numbers::pi * std::abs(index_of(record).imag()) * record.thickness_m / wavelength_m);
  };
  const auto turns = [&](const device::wt_material& record) {
    return 2 * index_of(record).real() * record.thickness_m / wavelength_m;
  };
  const double far = deviations * parameter.prior;
  const device::wt_material low = record_at(-far), high = record_at(far);
  if (!std::isfinite(low.thickness_m) || !(std::max(echo(low), echo(high)) > least_echo)) return 0;
  return std::abs(turns(high) - turns(low));
}

}  // namespace

double oscillations(const NamedRecords& world, const Parameter& parameter) {
  if (parameter.property != Property::permittivity && parameter.property != Property::thickness) return 0;
  double most = 0;
  for (const uint32_t record : parameter.records) most = std::max(most, oscillations_of(world, parameter, record));
  return most;
}

// Every parameter takes as many values as there are samples, so the one with the most oscillations decides. But where
// other parameters differ as well from sample to sample, more samples tell less of it.
size_t prior_samples(const NamedRecords& world, std::span<const Parameter> parameters) {
  const auto count = static_cast<double>(parameters.size()), least = samples_of_parameter * count;
  double wanted = least;
  for (const Parameter& parameter : parameters)
    wanted = std::max(wanted, std::ceil(samples_of_oscillation * oscillations(world, parameter) / count));
  return static_cast<size_t>(std::min(wanted, std::max(least, static_cast<double>(most_prior_samples))));
}

}  // namespace wavetracer::calibration
