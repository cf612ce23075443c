// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/discovery/waypoints.cl.
// One ray per work-item.
#include "passes/waypoints.hpp"

#include <stdexcept>

namespace wavetracer {

Waypoints::Waypoints(gpu::Context& context, uint32_t max_depth)
    : context_(context),
      kernel_(context),
      gather_(context),
      stride_(max_depth + 1),
      local_(context.info().simple_local_size()) {}

void Waypoints::reserve(uint64_t samples) {
  list_ = context_.buffer<wt_waypoint>(samples * stride_, "waypoints (see trace.batch_rays)");
}

void Waypoints::begin_batch(uint32_t first_sample, uint32_t count) {
  if (size_t{count} * stride_ > list_.size()) throw std::logic_error("waypoints: no room for the samples");
  first_sample_ = first_sample;
}

void Waypoints::operator()(const RayQueue& rays, const HitList& hits, uint32_t depth,
                           const gpu::Buffer<float>* traced) {
  kernel_({rays.count, local_}, Stage::waypoints,
          calls::waypoints::waypoints{.rays = rays.planes,
                                      .hits = hits.planes,
                                      .traced = traced,
                                      .capacity = rays.capacity,
                                      .ray_count = rays.count,
                                      .first_sample = first_sample_,
                                      .depth = depth,
                                      .stride = stride_,
                                      .out = list_});
}

std::vector<wt_waypoint> Waypoints::rows(const std::vector<uint32_t>& samples) {
  if (samples.empty()) return {};
  if (samples_.size() < samples.size()) {
    const size_t room = samples.size() + samples.size() / 4;
    rows_ = context_.buffer<wt_waypoint>(room * stride_, "waypoints of samples");
    samples_ = context_.buffer<uint32_t>(room, "samples");  // last, since its size is the room that there is
  }
  std::vector<uint32_t> slots = samples;
  for (uint32_t& slot : slots) slot -= first_sample_;
  samples_.write(slots);
  const size_t count = samples.size() * stride_;
  gather_({count, local_}, Stage::waypoints,
          calls::waypoints::gather_waypoints{.rows = list_,
                                             .list = samples_,
                                             .count = static_cast<uint32_t>(samples.size()),
                                             .stride = stride_,
                                             .out = rows_});
  return rows_.read(0, count, Stage::waypoints);
}

}  // namespace wavetracer
