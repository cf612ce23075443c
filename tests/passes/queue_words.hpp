// SPDX-License-Identifier: Apache-2.0
// Ray queues as plain words, for tests of passes that move or fill planes and must leave all other words as they are.
#pragma once
#include <vector>

#include "passes/triangles.hpp"

namespace wavetracer::test {

// Returns the words of a queue, plane after plane, with the padding behind the last ray.
inline std::vector<uint32_t> words_of(const RayQueue& queue) {
  std::vector<uint32_t> out;
  for (const float word : queue.planes.read()) out.push_back(std::bit_cast<uint32_t>(word));
  return out;
}

inline void write_words(RayQueue& queue, const std::vector<uint32_t>& words) {
  std::vector<float> planes;
  for (const uint32_t word : words) planes.push_back(std::bit_cast<float>(word));
  queue.planes.write(planes);
}

// Makes a queue of this many rays in which every word, also those of the padding, is random.
inline RayQueue random_queue(uint32_t seed, uint32_t rays, uint32_t plane_count) {
  Random random(seed);
  RayQueue queue = make_ray_queue(context(), rays, "random words", plane_count);
  queue.count = rays;
  std::vector<uint32_t> words(queue.planes.size());
  for (uint32_t& word : words) word = random.below(0xFFFFFFFFu);
  write_words(queue, words);
  return queue;
}

}  // namespace wavetracer::test
