// SPDX-License-Identifier: Apache-2.0
// The units into which a run is cut, so that any number of processes can share it: shards of frames, or, for a run of
// one frame, blocks of transmitters. The cut depends on the configuration and --frames alone, never on the processes.
// Every process goes through units with the same loop, for_each_unit(), in an order of its own.
#pragma once
#include <compare>
#include <cstdint>
#include <functional>
#include <string>

namespace wavetracer {

struct Unit {
  uint32_t first = 0, last = 0;    // frames
  uint32_t block = 0, blocks = 1;  // block of the transmitters; more than one only if there is one frame
  uint64_t frames() const { return uint64_t{last} - first + 1; }
  auto operator<=>(const Unit&) const = default;
};

// Returns the name of its files: "frames_000010_000019", "frames_000000_000000_block_02_of_32".
std::string unit_name(const Unit& unit);
// Returns text for people: "frames 10 to 19", "block 3 of 32".
std::string unit_words(const Unit& unit);

class Units {
 public:
  Units() = default;
  // Shards begin at absolute multiples of shard_frames. blocks: of the frame, if there is only one.
  Units(uint32_t first, uint32_t last, uint32_t shard_frames, uint32_t blocks = 1);
  uint64_t count() const { return count_; }
  Unit at(uint64_t index) const;

 private:
  uint32_t first_ = 0, last_ = 0, shard_frames_ = 1, blocks_ = 1;
  uint64_t count_ = 0;
};

// The order in which a process comes to units: `count` indices from `first` on, each `step` higher than the one before;
// after the last unit of the run, the order goes on from unit 0.
struct UnitOrder {
  uint64_t first = 0, step = 1, count = 0;
};

// The decision of a process about a unit that is not finished.
enum class UnitChoice {
  compute,    // this process computes it now
  elsewhere,  // another process, which lives, computes it
  leave,      // nobody computes it
  stop        // this process looks at no more units
};

// The three things that a process does with units. All functions are called on the thread that runs the loop.
struct UnitLoop {
  std::function<bool(const Unit&)> finished;      // the loop skips units for which this is true
  std::function<UnitChoice(const Unit&)> choose;  // called for all other units
  std::function<bool(const Unit&)> compute;       // false if an interrupt came before the unit was whole
};

// Numbers of units that were not finished when a loop came to them.
struct UnitCounts {
  uint64_t computed = 0, elsewhere = 0;
  uint64_t left = 0;  // nobody computes them, or an interrupt came in the middle
  uint64_t missing() const { return elsewhere + left; }
};

// Comes to units in this order: skips, chooses, computes. Throws what the functions throw.
UnitCounts for_each_unit(const Units& units, const UnitOrder& order, const UnitLoop& loop);

}  // namespace wavetracer
