// SPDX-License-Identifier: Apache-2.0
// The depth of tracing, in one place: the lengths of paths, sequences and rays that a configuration asks for.
#pragma once
#include <algorithm>
#include <cstdint>

#include "wavetracer/config.hpp"

namespace wavetracer {

struct TracingDepth {
  uint32_t reflections = 0;    // most of a path without other interactions
  uint32_t sequences = 0;      // surfaces in the longest sequence
  uint32_t interactions = 0;   // most of a ray
  uint32_t transmissions = 0;  // most of a ray
  uint32_t edges = 0;          // most of a path
  uint32_t row = 0;            // interactions that a list of paths has room for in each path
};

// trace: without features that the scene does not need, see with_features.
inline TracingDepth tracing_depth(const TraceConfig& trace) {
  TracingDepth out;
  out.reflections = trace.reflection ? trace.max_depth : 0;
  // Wedges and tiles belong to surfaces that rays see, so these surfaces are also needed without reflection.
  const uint32_t seen = trace.diffraction || trace.scattering ? std::min(1u, trace.max_depth) : 0;
  out.sequences = trace.reflection ? out.reflections : seen;
  // A transmitted ray sees further surfaces, even if they do not reflect. The last interaction ends a ray.
  out.interactions = out.sequences > 0 && trace.transmission ? trace.max_depth : out.sequences;
  if (trace.transmission && out.interactions > 0)
    out.transmissions = std::min(trace.max_transmissions, out.interactions - 1);
  if (trace.diffraction) out.edges = std::min(trace.max_diffractions, trace.max_depth < 2 ? trace.max_depth : 8u);
  // Paths over more than two edges have no other interactions, and may be deeper than all others.
  out.row = std::max(trace.max_depth, out.edges);
  return out;
}

}  // namespace wavetracer
