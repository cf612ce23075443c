// SPDX-License-Identifier: Apache-2.0
// Launches are sorted before their rays exist, so that no ray has to be moved.
#include "simulation/ray_source.hpp"

#include <algorithm>

namespace wavetracer {

namespace {

LaunchDirections directions_of(const TraceConfig& trace, uint64_t rays) {
  return LaunchDirections(trace.directions, rays, trace.seed);
}

}  // namespace

RaySource::RaySource(gpu::Context& context, const TraceConfig& trace, const OrderPlan& plan, bool labels,
                     float extent_m)
    : context_(context),
      trace_(trace),
      sort_each_depth_(plan.each_depth),
      heights_(std::make_shared<LaunchHeights>(context)) {
  if (labels) label_.emplace(context);
  if (plan.key) order_.emplace(context, *plan.key, plan.bins, directions_of(trace, *trace.rays), extent_m, heights_);
}

void RaySource::reserve(uint64_t rays) {
  if (order_) order_->reserve(rays);
}

GenerateRays& RaySource::generator(uint64_t rays) {
  const auto found = generators_.find(rays);
  if (found != generators_.end()) return found->second;
  return generators_.emplace(rays, GenerateRays(context_, directions_of(trace_, rays), heights_)).first->second;
}

std::vector<LaunchPart> RaySource::launch(RayQueue& rays, const Launch& launch, uint64_t first, uint64_t count) {
  const uint64_t each = launch.rays_each();
  const auto [phase, stride] = launch.share;
  const bool sorted = order_ && launch.sorted && launch.rays == trace_.rays && stride == 1;
  GenerateRays& generate = generator(launch.rays);
  const uint32_t first_slot = rays.count;
  std::vector<LaunchPart> parts;
  for (uint64_t done = 0; done < count;) {
    const uint64_t number = (first + done) % each;  // number among this launcher's rays
    const Launcher& from = launch.who[(first + done) / each];
    const auto sample = rays.count;  // place in the queue
    const auto part = static_cast<uint32_t>(std::min(count - done, each - number));
    // Launchers whose rays are all in this batch share a launch on the device.
    const uint64_t whole =
        sorted || label_ || number != 0 || each % generate.rays_together() ? 0 : (count - done) / each;
    if (whole > 1) {
      const auto who = std::span(launch.who).subspan((first + done) / each, whole);
      generate(rays, who, phase, part, stride);  // generate_rays
      for (const Launcher& launcher : who) {
        parts.push_back({launcher.transmitter, static_cast<uint32_t>(first_slot + done), part, 0, each, phase, stride});
        done += part;
      }
      continue;
    }
    if (sorted) {
      const gpu::Buffer<uint32_t>& order = order_->sort_launch(number, part, from);  // order_keys, sort
      generate(rays, from, number, part, order);                                     // generate_rays
      if (label_) (*label_)(rays, sample, part, sample, order);                      // label_rays
    } else {
      generate(rays, from, phase + stride * number, part, stride);  // generate_rays
      if (label_) (*label_)(rays, sample, part, sample);            // label_rays
    }
    parts.push_back({from.transmitter, sample, part, number, each, phase + stride * number, stride});
    done += part;
  }
  return parts;
}

void RaySource::label(RayQueue& rays) {
  if (label_) (*label_)(rays);
}

void RaySource::sort(RayQueue& rays, RayQueue& spare, uint32_t depth) {
  if (sort_each_depth_ && depth > 1) order_->sort_queue(rays, spare);
}

}  // namespace wavetracer
