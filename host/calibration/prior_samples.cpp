// SPDX-License-Identifier: Apache-2.0
// The waves that both faces of a slab reflect differ in phase by 4 pi n d / wavelength, so a change of n d by half of a
// wavelength is one oscillation. In a Latin hypercube of N samples of a normal number neighbours are apart by 7.7 / N
// standard deviations where it is one and a half deviations from its mean. So with N = 20 times the oscillations of
// four deviations a sample is within a twentieth of an oscillation of the truth there, where the misfit is a third of
// what it is elsewhere.
#include "calibration/prior_samples.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "accuracy/latin_hypercube.hpp"
#include "radio/constants.hpp"

namespace wavetracer::calibration {
namespace {

constexpr size_t samples_of_parameter = 8, seed_of_samples = 1;
constexpr double most_prior_samples = 256;  // for one parameter
constexpr double samples_of_oscillation = 20, deviations = 2;
constexpr double least_echo = 0.05;  // the share of the amplitude that crosses a slab twice

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

std::vector<std::vector<double>> prior_samples(const NamedRecords& world, std::span<const Parameter> parameters) {
  std::vector<std::vector<double>> out =
      accuracy::normal_hypercube(samples_of_parameter * parameters.size(), parameters.size(), seed_of_samples);
  std::vector<double> turns;
  for (const Parameter& parameter : parameters) turns.push_back(oscillations(world, parameter));
  if (std::ranges::count_if(turns, [](double own) { return own > 0; }) == 1) {
    const auto one = static_cast<size_t>(std::ranges::max_element(turns) - turns.begin());
    const double wanted = std::min(std::ceil(samples_of_oscillation * turns[one]), most_prior_samples);
    for (const std::vector<double>& value : accuracy::normal_hypercube(static_cast<size_t>(wanted), 1, seed_of_samples))
      out.emplace_back(parameters.size(), 0.0)[one] = value[0];
  }
  for (std::vector<double>& row : out)
    for (size_t p = 0; p < row.size(); ++p) row[p] *= parameters[p].prior;
  return out;
}

}  // namespace wavetracer::calibration
