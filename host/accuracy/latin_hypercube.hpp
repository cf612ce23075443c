// Random inputs that fill their ranges evenly: of each dimension, every one of N equally likely intervals is drawn from
// once (M. D. McKay, R. J. Beckman, W. J. Conover, Technometrics 21(2), 1979).
// The same numbers on every machine for one seed.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace wavetracer::accuracy {

// Standard normal numbers: one row per sample, one column per dimension.
std::vector<std::vector<double>> normal_hypercube(size_t samples, size_t dimensions, uint64_t seed);

// The value that a standard normal number is below with this probability, 0 < probability < 1.
double normal_quantile(double probability);

}  // namespace wavetracer::accuracy
