// SPDX-License-Identifier: Apache-2.0
// One line of a figure: directions of its rays, their order and the shape of the launch. Mnemonics are those of A.
// Zhdanov, TU Munich, 2014, section 6.2.2, if the method is one of its six.
#pragma once
#include <cstdint>
#include <string>
#include <vector>
#include "wavetracer/config.hpp"

namespace wavetracer::study {

// order.bin_num of the thesis, in a picture of its histogram (figure 3.4); it does not say what it measured with.
constexpr uint32_t thesis_bins = 16;

struct Series {
  std::string mnemonic;
  std::string method;  // order.method by its plain name
  // Trace.directions: "random" is the thesis' unordered launch, "hilbert" is ordered from the start.
  std::string directions;
  std::string shape;  // launch.shape
  bool each_depth = false;
  uint32_t bins = thesis_bins;  // order.bin_num, for the methods with a histogram

  bool operator==(const Series&) const = default;
};

// The reference of all others: random directions, unsorted, launched in one dimension.
Series unordered();
// Returns the same directions under one of the methods of order.method, in its own launch shape.
Series ordered(const std::string& method);
// Directions along a Hilbert curve, which need no sort.
Series born_ordered();
Series with_shape(Series series, const std::string& shape);
Series with_bins(Series series, uint32_t bins);
// Appends these methods with 32, 64 and 128 bins.
std::vector<Series> with_finer_bins(std::vector<Series> series, const std::vector<std::string>& methods);
// Tells whether order.bin_num matters for the series.
bool has_bins(const Series& series);

// Returns the mnemonic, the launch shape if it is not the method's own, and the number of bins if it is not the
// thesis': "H3DH", "H3DH 2d", "H3DH 64 bins".
std::string label(const Series& series);

// Returns the keys of a config that a series and a ray count decide; --set must not change them.
const std::vector<std::string>& series_keys();
void apply(Config& config, const Series& series, uint64_t rays);

}  // namespace wavetracer::study
