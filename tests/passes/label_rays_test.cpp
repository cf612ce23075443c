// SPDX-License-Identifier: Apache-2.0
// label_rays: the planes that say where a launched ray comes from, against a loop over rays; no other word changes.
#include "passes/label_rays.hpp"

#include <doctest/doctest.h>

#include <functional>

#include "passes/queue_words.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint32_t launched_rays = 1000;

// A queue of random words whose nodes are roots, as launches write them: ray i is of transmitter 7 i and quarter i.
RayQueue launched_queue(uint32_t seed) {
  RayQueue queue = random_queue(seed, launched_rays, WT_RAY_LABELLED_PLANES);
  std::vector<uint32_t> words = words_of(queue);
  for (uint32_t i = 0; i < launched_rays; ++i)
    words[size_t{WT_RAY_NODE} * queue.capacity + i] = WT_ROOT | (i & 3) << WT_QUARTER_SHIFT | 7 * i;
  write_words(queue, words);
  return queue;
}

// Writes the labels of slot i into the words of a queue.
void label_on_host(std::vector<uint32_t>& words, uint32_t capacity, uint32_t i, uint32_t sample) {
  const auto word = [&](size_t plane) -> uint32_t& { return words[plane * capacity + i]; };
  word(WT_RAY_SAMPLE) = sample;
  word(WT_RAY_LEFT) = WT_NONE;
  word(WT_RAY_REGION) = 7 * i;
  word(WT_RAY_ENTRY) = WT_NONE;
}

using SampleOf = std::function<uint32_t(uint32_t)>;  // sample of the k-th ray of the range

void check_labels(RayQueue& queue, std::vector<uint32_t> before, uint32_t first, uint32_t count,
                  const SampleOf& sample_of) {
  for (uint32_t k = 0; k < count; ++k) label_on_host(before, queue.capacity, first + k, sample_of(k));
  CHECK(words_of(queue) == before);
}

}  // namespace

TEST_CASE("label_rays: rays of a range get samples in a row, and nothing beside the range or the labels is written") {
  LabelRays label(context());
  for (const auto& [first, count] :
       {std::pair{0u, 1u}, {0u, launched_rays}, {1u, 15u}, {16u, 16u}, {300u, 257u}, {999u, 1u}}) {
    CAPTURE(first);
    CAPTURE(count);
    RayQueue queue = launched_queue(1);
    const std::vector<uint32_t> before = words_of(queue);
    label(queue, first, count, 40'000'000);
    check_labels(queue, before, first, count, [](uint32_t k) { return 40'000'000 + k; });
  }
}

TEST_CASE("label_rays: rays that were launched in an order have the samples of that order") {
  LabelRays label(context());
  for (const auto& [first, count] : {std::pair{0u, launched_rays}, {5u, 33u}, {700u, 300u}}) {
    CAPTURE(first);
    std::vector<uint32_t> order(count);
    for (uint32_t k = 0; k < count; ++k) order[k] = (k * 37 + 11) % count;
    RayQueue queue = launched_queue(2);
    const std::vector<uint32_t> before = words_of(queue);
    label(queue, first, count, 123, context().buffer(order, "order"));
    check_labels(queue, before, first, count, [&](uint32_t k) { return 123 + order[k]; });
  }
}

TEST_CASE("label_rays: rays of a refined launch keep the samples that they have") {
  LabelRays label(context());
  RayQueue queue = launched_queue(3);
  queue.count = 321;
  const std::vector<uint32_t> before = words_of(queue);
  label(queue);
  check_labels(queue, before, 0, queue.count,
               [&](uint32_t k) { return before[size_t{WT_RAY_SAMPLE} * queue.capacity + k]; });
}
