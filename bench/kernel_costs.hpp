// What each kernel of a frame has to do at least, per element: the bytes that it must move and the operations that it
// must run. With what the device can do, that bounds its time from below.
// Costs are counted by reading the kernels; caches, divergence and the search in trees are not in them.
#pragma once
#include <span>
#include <string_view>

#include "wavetracer/simulation.hpp"

namespace wavetracer::bench {

// What the costs of a frame depend on.
struct FrameNumbers {
  const FrameResult& frame;
  const Config& config;
  size_t triangles;  // of the static scene

  double transmitters() const { return static_cast<double>(frame.world.transmitters.size()); }
  double receivers() const { return static_cast<double>(frame.world.receivers.size()); }
  // Work-items of a kernel of the frame; 0 where it did not run.
  double items(std::string_view kernel) const;
  double depth() const;         // reflections of a path, on average
  double hit_share() const;     // of all segments
  double cache_misses() const;  // of all look-ups
  // Candidates that pass "solve" by: diffracted or scattered ones.
  double beside_mirrors() const;
};

struct KernelCost {
  std::string_view kernel;   // "program/kernel"
  std::string_view world;    // in which it is measured, or a later one if that does not launch it on this device;
                             // empty: the first that launches it
  std::string_view element;  // in the plural
  double (*elements)(const FrameNumbers&);
  double (*bytes)(const FrameNumbers&);       // per element
  double (*operations)(const FrameNumbers&);  // per element
  bool in_double = false;                     // the operations
};

// Every kernel of the frames that bench_frame_kernels runs, but those of sorts, which bench_sort measures.
std::span<const KernelCost> kernel_costs();

}  // namespace wavetracer::bench
