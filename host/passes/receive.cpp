// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/discovery/receive.cl.
// A work-item takes one ray. If a list is too short, it is made longer, and the same rays run again.
#include "passes/receive.hpp"

#include "passes/advice.hpp"
#include "passes/growing_list.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

Receive::Receive(gpu::Context& context, double radius_m)
    : context_(context),
      receive_(context),
      receive_answered_(context, {{"WT_ANSWERED", "1"}}),
      first_(context),
      radius_m_(static_cast<float>(radius_m)),
      work_(tuning_of(context.info()).receive),
      list_(context.buffer<wt_reception>(1 << 16, "receptions")),
      counter_(context.buffer<uint32_t>(1, "receptions")) {
  begin_batch();
}

void Receive::begin_batch() {
  count_ = 0;
  counter_.write(std::vector{count_}, 0, Stage::receive);
}

void Receive::operator()(const RadioEnds& ends, const RayQueue& rays, const HitList& hits, uint32_t depth) {
  append(receive_, ends, rays, hits, depth, nullptr, nullptr);
}

void Receive::operator()(const RadioEnds& ends, const RayQueue& rays, const HitList& hits, uint32_t depth,
                         const gpu::Buffer<float>& traced, const gpu::Buffer<uint32_t>& answered) {
  append(receive_answered_, ends, rays, hits, depth, &traced, &answered);
}

void Receive::append(gpu::KernelOf<calls::receive::receive>& kernel, const RadioEnds& ends, const RayQueue& rays,
                     const HitList& hits, uint32_t depth, const gpu::Buffer<float>* traced,
                     const gpu::Buffer<uint32_t>* answered) {
  count_ = grow_until_filled(
      [&] {
        kernel(
            work_.range(rays.count), Stage::receive,
            calls::receive::receive{.rays = rays.planes,
                                    .hits = hits.planes,
                                    .receivers = ends.receiver_planes,
                                    .links = ends.links,
                                    .out = list_,
                                    .counter = counter_,
                                    .traced = gpu::Global<const uint32_t>::bits_of(traced),
                                    .answered = answered,
                                    .args = wt_receive_arguments{.capacity = rays.capacity,
                                                                 .ray_count = rays.count,
                                                                 .receiver_capacity = ends.receiver_capacity,
                                                                 .radius_m = radius_m_,
                                                                 .depth = depth,
                                                                 .out_capacity = static_cast<uint32_t>(list_.size())}});
      },
      [&] { return counter_.read_one(0, Stage::receive); }, [&] { return list_.size(); },
      [&](size_t entries) {
        auto longer = context_.buffer<wt_reception>(entries, {"receptions", advice::spheres});
        context_.copy(list_, longer, size_t{count_} * sizeof(wt_reception), Stage::receive);
        list_ = longer;
        counter_.write(std::vector{count_}, 0, Stage::receive);
      });
}

void Receive::first(const RadioEnds& ends, const RayQueue& rays, const HitList& hits, gpu::Buffer<uint32_t>& first) {
  first_(work_.range(rays.count), Stage::receive,
         calls::receive::first_receiver{
             .rays = rays.planes,
             .hits = hits.planes,
             .receivers = ends.receiver_planes,
             .links = ends.links,
             .first = first,
             .args = wt_receive_arguments{rays.capacity, rays.count, ends.receiver_capacity, radius_m_, 0, 0}});
}

std::vector<wt_reception> Receive::list() const { return list_.read(0, count_, Stage::receive); }

}  // namespace wavetracer
