// SPDX-License-Identifier: Apache-2.0
// Random inputs that fill their ranges evenly: in each dimension, exactly one sample is drawn from every one of N
// equally likely intervals (M. D. McKay, R. J. Beckman, W. J. Conover, Technometrics 21(2), 1979).
// A seed gives the same numbers on every machine.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace wavetracer::accuracy {

// Returns standard normal numbers: one row per sample, one column per dimension.
std::vector<std::vector<double>> normal_hypercube(size_t samples, size_t dimensions, uint64_t seed);

// Returns the value below which a standard normal number lies with this probability, 0 < probability < 1.
double normal_quantile(double probability);

}  // namespace wavetracer::accuracy
