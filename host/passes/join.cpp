// Host side of kernels/join.cl.
// One prefix a work-item; groups are small, because the ground ends many prefixes and a narrow wall few.
#include "passes/join.hpp"

#include <bit>

#include "passes/growing_list.hpp"

namespace wavetracer {

Join::Join(gpu::Context& context, const std::vector<uint32_t>& receiver_of_transmitter, uint32_t max_depth)
    : context_(context),
      prefixes_(context.kernel("join", "prefixes")),
      join_(context.kernel("join", "join")),
      max_depth_(max_depth),
      local_(context.info().simple_local_size()),
      receiver_of_transmitter_(context.buffer(receiver_of_transmitter, "receivers of ends")) {}

unsigned Join::key_bits(const DeviceScene& scene) {
  return static_cast<unsigned>(std::bit_width(scene.surfaces.size()));
}

PrefixList& Join::prefixes(const DeviceScene& scene, const RadioEnds& ends, const gpu::Buffer<uint64_t>& trie,
                           const gpu::Buffer<uint32_t>& nodes, uint32_t node_count) {
  if (list_.keys.size() < node_count + 16) {
    const size_t capacity = size_t{node_count} + node_count / 4 + 16;
    list_ = {context_.buffer<uint32_t>(capacity, "prefix keys"), context_.buffer<uint32_t>(capacity, "prefix order"),
             context_.buffer<float>(8 * capacity, "prefixes")};
  }
  list_.count = node_count;
  prefixes_({node_count, local_}, "join", trie, nodes, node_count, joined_depth(max_depth_),
            static_cast<uint32_t>(scene.surfaces.size()), ends.transmitters, scene.exact_surfaces, list_.keys,
            list_.prefixes);
  return list_;
}

uint32_t Join::operator()(const DeviceScene& scene, const RadioEnds& ends, const gpu::Buffer<uint32_t>& nodes,
                          gpu::Buffer<wt_candidate>& candidates, uint32_t candidate_count,
                          gpu::Buffer<wt_counters>& counters) {
  const auto run = [&] {
    join_({list_.count, 64}, "join", list_.keys, list_.order, list_.count, static_cast<uint32_t>(scene.surfaces.size()),
          nodes, list_.prefixes, receiver_of_transmitter_, ends.links, ends.receiver_capacity / 16, max_depth_,
          scene.surfaces, candidates, static_cast<uint32_t>(candidates.size()), counters);
  };
  const auto reserve = [&](size_t entries) {
    auto larger = context_.buffer<wt_candidate>(entries, "candidates");
    context_.copy(candidates, larger, candidate_count * sizeof(wt_candidate), "join");
    candidates = larger;
  };
  return fill_list(counters, &wt_counters::candidates, "join", [&] { return candidates.size(); }, run, reserve,
                   candidate_count);
}

}  // namespace wavetracer
