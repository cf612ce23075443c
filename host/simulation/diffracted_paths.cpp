// Meeting at the edge.
// No ray need hit an edge: a ray that meets a face says that its prefix sees the wedges of that face.
#include "simulation/diffracted_paths.hpp"

namespace wavetracer {

DiffractedPaths::DiffractedPaths(gpu::Context& context, Wedges wedges, const std::vector<uint32_t>& receiver_of_origin,
                                 const TraceConfig& config)
    : context_(context),
      wedges_(std::move(wedges)),
      prefixes_(context),
      sort_(context),
      join_(context, receiver_of_origin, config.max_depth, config.max_diffractions > 1),
      solve_(context, config.max_depth) {}

SolvedList& DiffractedPaths::operator()(const DeviceScene& scene, const RadioEnds& ends, Sequences& sequences,
                                        uint32_t node_count, uint64_t& candidates) {
  wedges_(scene);
  WedgePrefixList& prefixes = prefixes_(scene, wedges_, ends, sequences.table(), sequences.quarters(),
                                        sequences.nodes(), node_count, sequences.counters());
  const size_t words = sort_.temporary_words(prefixes.count);
  if (temporary_.size() < words) temporary_ = context_.buffer<uint32_t>(words + words / 4, "sort");
  if (prefixes.count > 0) sort_(prefixes.keys, prefixes.order, prefixes.count, temporary_, wedges_.key_bits());
  const uint32_t count = join_(scene, prefixes, wedges_, ends, sequences.counters());
  candidates += count;
  return solve_(scene, wedges_, ends, sequences.table(), join_.list(), count, sequences.counters());
}

}  // namespace wavetracer
