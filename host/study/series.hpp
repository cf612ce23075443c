// SPDX-License-Identifier: Apache-2.0
// One line of a figure: directions of its rays, their order and the shape of the launch. Mnemonics are those of A.
// Zhdanov, TU Munich, 2014, section 6.2.2, if the method is one of its six.
#pragma once
#include <cstdint>
#include <string>
#include <vector>
#include "wavetracer/config.hpp"

namespace wavetracer::study {

struct Series {
  std::string mnemonic;
  std::string method;  // order.method by its plain name
  // Trace.directions: "random" is the thesis' unordered launch, "hilbert" is ordered from the start.
  std::string directions;
  std::string shape;  // launch.shape
  bool each_depth = false;

  bool operator==(const Series&) const = default;
};

// The reference of all others: random directions, unsorted, launched in one dimension.
Series unordered();
// Returns the same directions under one of the methods of order.method, in its own launch shape.
Series ordered(const std::string& method);
// Directions along a Hilbert curve, which need no sort.
Series born_ordered();
Series with_shape(Series series, const std::string& shape);

// Returns the mnemonic, and the launch shape if it is not the method's own: "H3DH", "H3DH 2d".
std::string label(const Series& series);

// Returns the keys of a config that a series and a ray count decide; --set must not change them.
const std::vector<std::string>& series_keys();
void apply(Config& config, const Series& series, uint64_t rays);

}  // namespace wavetracer::study
