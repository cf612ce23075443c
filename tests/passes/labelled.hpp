// SPDX-License-Identifier: Apache-2.0
// Makes labelled ray queues and invented hits for the tests of passes that follow rays.
// A label is what label_rays and interact write: sample and transmitter.
#pragma once
#include <vector>

#include "passes/on_device.hpp"

namespace wavetracer::test {

struct LabelledRay {
  Ray ray;
  uint32_t sample = 0, transmitter = 0;
  Hit hit;  // hit of its segment
};

inline RayQueue upload_labelled(const std::vector<LabelledRay>& rays) {
  RayQueue queue = make_ray_queue(context(), rays.size(), "test rays", WT_RAY_LABELLED_PLANES);
  queue.count = static_cast<uint32_t>(rays.size());
  std::vector<float> planes(queue.planes.size(), 0.0f);
  const auto word = [&](size_t plane, size_t i, uint32_t value) {
    planes[plane * queue.capacity + i] = std::bit_cast<float>(value);
  };
  for (size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = rays[i].ray;
    for (size_t axis = 0; axis < 3; ++axis) {
      planes[(WT_RAY_ORIGIN + axis) * queue.capacity + i] = ray.origin[axis];
      planes[(WT_RAY_DIRECTION + axis) * queue.capacity + i] = ray.direction[axis];
    }
    word(WT_RAY_NODE, i, ray.node);
    word(WT_RAY_SURFACE, i, ray.surface);
    word(WT_RAY_SAMPLE, i, rays[i].sample);
    word(WT_RAY_LEFT, i, WT_NONE);
    word(WT_RAY_REGION, i, rays[i].transmitter);
    word(WT_RAY_ENTRY, i, WT_NONE);
  }
  queue.planes.write(planes);
  return queue;
}

inline HitList upload_hits_of(const std::vector<LabelledRay>& rays) {
  HitList list = make_hit_list(context(), rays.size());
  std::vector<float> planes(list.planes.size(), std::bit_cast<float>(0x7FC00000u));  // a miss may have any distance
  for (size_t i = 0; i < rays.size(); ++i) {
    const Hit& hit = rays[i].hit;
    if (!hit.missed()) planes[size_t{WT_HIT_T} * list.capacity + i] = hit.t;
    planes[size_t{WT_HIT_PRIMITIVE} * list.capacity + i] = std::bit_cast<float>(hit.primitive);
    planes[size_t{WT_HIT_SURFACE} * list.capacity + i] = std::bit_cast<float>(hit.surface);
  }
  list.planes.write(planes);
  return list;
}

}  // namespace wavetracer::test
