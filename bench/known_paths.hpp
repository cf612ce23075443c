// All paths of a frame that any of several launches has found: as near to the truth as launches come.
// Assumes launches of one world, by one program: paths are the same where path_recall says so.
#pragma once
#include <cstddef>

#include "wavetracer/paths.hpp"

namespace wavetracer::bench {

class KnownPaths {
 public:
  // Keeps what is new of a frame.
  void add(const Paths& found);
  size_t size() const { return paths_.size(); }
  double power() const;  // sum of |a|^2 over all ports
  const Paths& paths() const { return paths_; }

  struct Lost {
    size_t paths = 0;
    double power = 0;  // sum of |a|^2
  };
  // What is known and not among these.
  Lost lost(const Paths& found) const;

 private:
  Paths paths_;  // ends, delays, coefficients and what is touched; other columns are empty
};

}  // namespace wavetracer::bench
