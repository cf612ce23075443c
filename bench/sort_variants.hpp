// SPDX-License-Identifier: Apache-2.0
// Tunings of the radix sort for groups, tried in one run: what radix_groups() of host/passes/tuning.hpp has was chosen
// among them.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace wavetracer::bench {

// Every choice of a list is tried with every one of the others.
struct VariantOptions {
  std::string device, cub;  // cub: the program built of bench/peers/cub_sort.cu, or empty
  size_t runs = 7;
  unsigned largest = 0;                                                 // only --largest: no larger powers
  std::vector<unsigned> powers{20, 22, 24, 26};                         // 2^power keys
  std::vector<std::string> shapes{"u32", "u32+u32", "u64", "u64+u32"};  // keys, or keys and a word each
  std::vector<std::string> ranks{"votes", "match"};                     // also masks and columns
  std::vector<uint32_t> items{128, 256, 384, 512}, item_keys{8, 12, 16, 20, 24}, columns{72}, windows{4}, looks{1000},
      registers{0}, count_groups{1056};
  std::vector<unsigned> late{1};     // late values, for shapes with words
  std::vector<unsigned> tickets{1};  // tiles by tickets
};

// Prints a row for each tuning that the device has the local memory for: keys per second by wall time beside CUB's, and
// the time of each kernel. All tunings of a shape are measured in turn, so that a slow phase of the machine slows them
// all. The first result of a shape is compared with rules of a stable sort on the host, the others with the first.
void measure_sort_variants(const VariantOptions& options, const std::string& command);

}  // namespace wavetracer::bench
