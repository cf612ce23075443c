// SPDX-License-Identifier: Apache-2.0
// The units into which a run is cut, so that any number of processes can share it: shards of frames, or, for a run of
// one frame, blocks of transmitters. The cut depends on the configuration and --frames alone, never on the processes.
#pragma once
#include <compare>
#include <cstdint>
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

}  // namespace wavetracer
