// SPDX-License-Identifier: Apache-2.0
// All paths of a frame that any of several launches has found: the best available approximation of the truth.
// The launches must be of one world, by one program: paths are the same if path_recall says so.
#pragma once
#include <cstddef>

#include "wavetracer/paths.hpp"

namespace wavetracer::bench {

class KnownPaths {
 public:
  // Adds the new paths of a frame.
  void add(const Paths& found);
  size_t size() const { return paths_.size(); }
  double power() const;  // sum of |a|^2 over all ports
  const Paths& paths() const { return paths_; }

  struct Lost {
    size_t paths = 0;
    double power = 0;  // sum of |a|^2
  };
  // Returns the known paths that are not among these.
  Lost lost(const Paths& found) const;

 private:
  Paths paths_;  // ends, delays, coefficients and what is touched; other columns are empty
};

}  // namespace wavetracer::bench
