// Meeting in the middle: prefixes of the ends that send and receive, sorted by the surface they end on, and joined.
// Half as deep a launch an end then serves all its links, where both ends of every link launch.
#pragma once
#include <vector>

#include "passes/join.hpp"
#include "passes/sequences.hpp"
#include "passes/sort.hpp"

namespace wavetracer {

class MeetingPrefixes {
 public:
  // receiver_of_transmitter: see World.
  MeetingPrefixes(gpu::Context& context, const std::vector<uint32_t>& receiver_of_transmitter, uint32_t max_depth)
      : context_(context), join_(context, receiver_of_transmitter, max_depth), sort_(context) {}

  // Appends the joined candidates; node_count as of sequences.collect(). Returns the number of all candidates.
  uint32_t operator()(const DeviceScene& scene, const RadioEnds& ends, Sequences& sequences, uint32_t node_count,
                      gpu::Buffer<wt_candidate>& candidates, uint32_t candidate_count) {
    PrefixList& list = join_.prefixes(scene, ends, sequences.table(), sequences.nodes(), node_count);
    const size_t words = sort_.temporary_words(list.count);
    if (temporary_.size() < words) temporary_ = context_.buffer<uint32_t>(words + words / 4, "sort");
    sort_(list.keys, list.order, list.count, temporary_, Join::key_bits(scene));
    return join_(scene, ends, sequences.nodes(), candidates, candidate_count, sequences.counters());
  }

 private:
  gpu::Context& context_;
  Join join_;
  Sort sort_;
  gpu::Buffer<uint32_t> temporary_;
};

}  // namespace wavetracer
