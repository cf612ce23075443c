// One line of a figure: where its rays point, how they are ordered and in which shape they are launched.
// Mnemonics are those of A. Zhdanov, TU Munich, 2014, section 6.2.2, where the method is one of its six.
#pragma once
#include <cstdint>
#include <string>
#include <vector>
#include "wavetracer/config.hpp"

namespace wavetracer::study {

struct Series {
  std::string mnemonic;
  std::string method;      // order.method by its plain name
  std::string directions;  // trace.directions: "random" is the thesis' unordered launch, "hilbert" is born in order
  std::string shape;       // launch.shape
  bool each_depth = false;

  bool operator==(const Series&) const = default;
};

// What all others are compared with: random directions, unsorted, launched in one dimension.
Series unordered();
// The same directions under one of the methods of order.method, in the launch shape that is its own.
Series ordered(const std::string& method);
// Directions along a Hilbert curve, which need no sort.
Series born_ordered();
Series with_shape(Series series, const std::string& shape);

// The mnemonic, and the launch shape where it is not the method's own: "H3DH", "H3DH 2d".
std::string label(const Series& series);

// The keys of a config that a series and a ray count decide; --set must leave them alone.
const std::vector<std::string>& series_keys();
void apply(Config& config, const Series& series, uint64_t rays);

}  // namespace wavetracer::study
