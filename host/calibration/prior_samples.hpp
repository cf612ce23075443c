// SPDX-License-Identifier: Apache-2.0
// The number of samples from which a fit of materials may start.
#pragma once
#include <cstddef>
#include <span>

#include "calibration/parameters.hpp"

namespace wavetracer::calibration {

// The size of a sample of all parameters: eight for each, and twenty for each oscillation of a slab's reflection within
// the prior of the only parameter, fewer where there are several. It is bounded, since each sample takes an evaluation
// of the fields.
constexpr size_t most_prior_samples = 256;
size_t prior_samples(const NamedRecords& world, std::span<const Parameter> parameters);

// The number of oscillations of the reflection of a slab over two standard deviations of the prior to both sides, at
// normal incidence. A wave that is lost on its way through the slab and back makes none.
double oscillations(const NamedRecords& world, const Parameter& parameter);

}  // namespace wavetracer::calibration
