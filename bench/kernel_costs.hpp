// SPDX-License-Identifier: Apache-2.0
// The minimal work of each kernel of a frame, per element: the bytes that it must move and the operations that it must
// run. With the limits of the device, that gives a lower bound of its time.
// Costs are counted by reading the kernels; caches, divergence and searches in trees are not included.
#pragma once
#include <span>
#include <string_view>

#include "passes/tuning.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::bench {

// The numbers that the costs of a frame depend on.
struct FrameNumbers {
  const FrameResult& frame;
  const Config& config;
  size_t triangles;  // in the static scene
  const Tuning& tuning;

  double transmitters() const { return static_cast<double>(frame.world.transmitters.size()); }
  double receivers() const { return static_cast<double>(frame.world.receivers.size()); }
  // Work-items of a kernel of the frame; 0 if it did not run.
  double items(std::string_view kernel) const;
  double depth() const;         // average number of reflections of a path
  double hit_share() const;     // share of all segments
  double cache_misses() const;  // number over all look-ups
  // Number of candidates that do not go through "solve": diffracted or scattered ones.
  double beside_mirrors() const;
};

struct KernelCost {
  std::string_view kernel;   // "program/kernel"
  std::string_view world;    // the world in which it is measured, or a later one if that does not launch it on this
                             // device; empty: the first that launches it
  std::string_view element;  // in the plural
  double (*elements)(const FrameNumbers&);
  double (*bytes)(const FrameNumbers&);       // per element
  double (*operations)(const FrameNumbers&);  // per element
  bool in_double = false;                     // the operations are in double
  double gathers = 0;                         // places of memory that an element visits at random
  bool slots = false;                         // such a place has 64 bytes, else at most eight
};

// Returns every kernel of the frames that bench_kernels runs. Those of sorts are not among them (sort_kernels.hpp).
std::span<const KernelCost> kernel_costs();

// The operations of a ray that is traced through a tree of so many triangles, or through one of so many instances.
double tree_operations(size_t triangles);
double instance_tree_operations(size_t instances);

}  // namespace wavetracer::bench
