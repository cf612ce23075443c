// The power of a path.
#pragma once
#include <complex>
#include <cstddef>

#include "wavetracer/paths.hpp"

namespace wavetracer {

// Received power of path `row` by transmitted power: |a|^2, summed over pairs of ports.
inline double power_of(const Paths& paths, size_t row) {
  double power = 0;
  for (const auto& a : paths.a[row]) power += std::norm(a);
  return power;
}

}  // namespace wavetracer
