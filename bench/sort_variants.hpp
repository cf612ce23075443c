// SPDX-License-Identifier: Apache-2.0
// Tunings of the radix sort for groups, tried in one run: what radix_groups() of host/passes/tuning.hpp has was chosen
// among them.
#pragma once
#include <cstddef>
#include <string>

namespace wavetracer::bench {

struct VariantOptions {
  std::string device, cub;  // cub: the program built of bench/peers/cub_sort.cu, or empty
  size_t runs = 7;
  unsigned largest = 0;  // most keys, as a power of two; 0 means one that suits the device
};

// Prints a row for each tuning that the device has the local memory for, with 2^20 to 2^26 keys of 32 and 64 bits, with
// a word each and without: keys per second by wall time beside CUB's, and the time of each kernel. All tunings of a
// shape are measured in turn, so that a slow phase of the machine slows them all.
void measure_sort_variants(const VariantOptions& options, const std::string& command);

}  // namespace wavetracer::bench
