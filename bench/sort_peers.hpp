// SPDX-License-Identifier: Apache-2.0
// The peers of the sort benchmark: the sorts of C++ and its libraries on the host, and a program for CUDA devices.
// Every peer sorts the same keys as ours, restored before each run; only the sort is timed.
#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace wavetracer::bench {

// The data to sort: n keys of which the lowest `bits` bits differ, alone or with a 32-bit word each.
struct SortShape {
  unsigned key_bits = 32;  // 32 or 64
  bool payload = false;
  uint32_t n = 0;
  unsigned bits = 32;
  auto operator<=>(const SortShape&) const = default;
};

struct SortPeer {
  std::string name;
  std::function<double()> run;  // returns seconds; throws RuntimeError if the result is not sorted
};

// Returns tbb::parallel_sort, and hwy::VQSort if it was found; with `slow`, std::sort and std::stable_sort too. Pairs
// are structs. Only std::stable_sort is stable, as ours is.
template <class Key>
std::vector<SortPeer> host_peers(const std::vector<Key>& keys, bool payload, bool slow);

// Name and seconds of every sort that a program has for a shape.
using ProgramTimes = std::map<SortShape, std::vector<std::pair<std::string, double>>>;

// Runs `program` (see peers/cub_sort.cu) once over all shapes. Throws InputError if it fails or its output is invalid.
ProgramTimes run_program(const std::string& program, const std::vector<SortShape>& shapes, size_t runs);

}  // namespace wavetracer::bench
