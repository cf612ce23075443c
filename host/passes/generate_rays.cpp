// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/rays/generate_rays.cl.
// The queue must have room: the frame loop sizes its batches.
#include "passes/generate_rays.hpp"

#include <stdexcept>
#include <utility>

namespace wavetracer {

namespace {
void check_room(const RayQueue& queue, uint32_t count) {
  if (uint64_t{queue.count} + count + 16 > queue.capacity) throw std::logic_error("generate_rays: the queue is full");
}

wt_launcher_arguments arguments_of(const Launcher& from, const LaunchHeights& heights) {
  return {{static_cast<float>(from.position_m.x), static_cast<float>(from.position_m.y),
           static_cast<float>(from.position_m.z)},
          WT_ROOT | from.transmitter,
          from.source,
          heights.place(from.heights),
          from.window ? 1u : 0u};
}

gpu::Definitions with_samples(gpu::Definitions definitions) {
  definitions["WT_SAMPLES"] = "1";
  return definitions;
}
}  // namespace

GenerateRays::GenerateRays(gpu::Context& context, const LaunchDirections& directions,
                           std::shared_ptr<const LaunchHeights> heights)
    : context_(context),
      generate_(context, directions.definitions()),
      generate_launchers_(context, directions.definitions()),
      generate_ordered_(context, directions.definitions()),
      generate_samples_(context, with_samples(directions.definitions())),
      directions_(directions),
      heights_(heights ? std::move(heights) : std::make_shared<const LaunchHeights>(context)),
      work_(tuning_of(context.info()).generate_rays) {}

void GenerateRays::operator()(RayQueue& queue, const Launcher& from, uint64_t first, uint32_t count, uint64_t stride) {
  check_room(queue, count);
  generate_(work_.range(count), Stage::generate_rays,
            calls::generate_rays::generate_rays{
                .rays = queue.planes,
                .heights = heights_->tables(),
                .map = directions_.arguments(),
                .from = arguments_of(from, *heights_),
                .args = wt_launch_arguments{.first_index = first,
                                            .stride = stride,
                                            .number = static_cast<uint32_t>(first / stride & 3),
                                            .capacity = queue.capacity,
                                            .first_slot = queue.count,
                                            .count = count}});
  queue.count += count;
}

void GenerateRays::operator()(RayQueue& queue, std::span<const Launcher> from, uint64_t first, uint32_t count,
                              uint64_t stride) {
  const auto rays = static_cast<uint32_t>(from.size()) * count;
  check_room(queue, rays);
  std::vector<wt_launcher_arguments> launchers;
  for (const Launcher& launcher : from) launchers.push_back(arguments_of(launcher, *heights_));
  if (launchers_.size() < launchers.size())
    launchers_ = context_.buffer<wt_launcher_arguments>(launchers.size(), "launchers");
  launchers_.write(launchers, 0, Stage::generate_rays);
  generate_launchers_(work_.range(rays), Stage::generate_rays,
                      calls::generate_rays::generate_launchers{
                          .rays = queue.planes,
                          .heights = heights_->tables(),
                          .map = directions_.arguments(),
                          .launchers = launchers_,
                          .launcher_count = static_cast<uint32_t>(from.size()),
                          .args = wt_launch_arguments{.first_index = first,
                                                      .stride = stride,
                                                      .number = static_cast<uint32_t>(first / stride & 3),
                                                      .capacity = queue.capacity,
                                                      .first_slot = queue.count,
                                                      .count = count}});
  queue.count += rays;
}

void GenerateRays::operator()(RayQueue& queue, const Launcher& from, uint64_t first, uint32_t count,
                              const gpu::Buffer<uint32_t>& order) {
  check_room(queue, count);
  generate_ordered_(work_.range(count), Stage::generate_rays,
                    calls::generate_rays::generate_ordered{.rays = queue.planes,
                                                           .order = order,
                                                           .heights = heights_->tables(),
                                                           .map = directions_.arguments(),
                                                           .from = arguments_of(from, *heights_),
                                                           .args = wt_launch_arguments{.first_index = first,
                                                                                       .stride = 1,
                                                                                       .number = 0,
                                                                                       .capacity = queue.capacity,
                                                                                       .first_slot = queue.count,
                                                                                       .count = count}});
  queue.count += count;
}

void GenerateRays::samples(RayQueue& queue, SampleList& list, uint32_t first, uint32_t count,
                           const gpu::Buffer<float>& launchers, const LaunchDirections& directions,
                           DirectionTurn turn) {
  queue.count = 0;
  check_room(queue, count);
  generate_samples_(
      work_.range(count), Stage::generate_rays,
      calls::generate_rays::generate_samples{.rays = queue.planes,
                                             .samples = list.samples,
                                             .launchers = launchers,
                                             .heights = heights_->tables(),
                                             .ends = list.ends,
                                             .map = directions.arguments(),
                                             .args = wt_samples_arguments{.capacity = queue.capacity,
                                                                          .first = first,
                                                                          .count = count,
                                                                          .sample_capacity = list.capacity,
                                                                          .cosine = turn.cosine,
                                                                          .sine = turn.sine,
                                                                          .turn = turn.turn}});
  queue.count = count;
}

}  // namespace wavetracer
