// SPDX-License-Identifier: Apache-2.0
// Joins batches of receivers (receiver_batches.hpp) to their frame. Sums of links go to their places as soon as a batch
// is there, since maps have millions of them; paths are joined at the end.
#pragma once
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "wavetracer/frame_result.hpp"
#include "wavetracer/link_figures.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

class JoinedBatches {
 public:
  // links: all links of the frame, sorted. room: memory that its sums use, if it is large enough.
  JoinedBatches(std::vector<Link> links, std::vector<LinkFigures> room)
      : links_(std::move(links)), room_(std::move(room)) {}

  // Adds a batch: the links of a range of receivers after those of the batch before. Batches are of one world, without
  // a cache or waypoints. Returns the memory of the batch's sums.
  std::vector<LinkFigures> add(FrameResult batch);
  size_t size() const { return batches_.size(); }
  // Returns the frame, once all batches are there, at least one. Counts and seconds are those of all work.
  FrameResult joined();

 private:
  void place(const SummedPaths& part);

  std::vector<Link> links_;
  std::vector<LinkFigures> room_;
  std::optional<SummedPaths> summed_;
  std::vector<FrameResult> batches_;
};

}  // namespace wavetracer
