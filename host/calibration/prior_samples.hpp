// SPDX-License-Identifier: Apache-2.0
// The places from which a fit of materials may start.
#pragma once
#include <span>
#include <vector>

#include "calibration/parameters.hpp"

namespace wavetracer::calibration {

// Samples of theta within the priors: a Latin hypercube of eight for each parameter. Where the reflection of a slab
// oscillates over one parameter alone there are more, of that parameter with all others as they are: twenty for each
// oscillation within its prior, at most 256, since each takes an evaluation of the fields. For several such parameters
// the product of these numbers would be needed.
std::vector<std::vector<double>> prior_samples(const NamedRecords& world, std::span<const Parameter> parameters);

// The number of oscillations of the reflection of a slab over two standard deviations of the prior to both sides, at
// normal incidence. A wave that is lost on its way through the slab and back makes none.
double oscillations(const NamedRecords& world, const Parameter& parameter);

}  // namespace wavetracer::calibration
