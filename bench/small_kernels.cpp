// SPDX-License-Identifier: Apache-2.0
// Each case frees its buffers before the next one allocates its own.
#include "small_kernels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <execution>
#include <numeric>
#include <random>

#include "passes/compact.hpp"
#include "passes/curves.hpp"
#include "passes/gather_rays.hpp"
#include "passes/generate_rays.hpp"
#include "passes/order_keys.hpp"
#include "passes/scan.hpp"
#include "wavetracer/device/directions.h"

namespace wavetracer::bench {
namespace {

constexpr uint32_t most_checked = 1u << 20;
constexpr uint64_t seed = 1;

std::vector<uint32_t> random_words(size_t count, uint32_t mask = ~0u) {
  std::mt19937 generator(1);
  std::vector<uint32_t> words(count);
  for (uint32_t& word : words) word = static_cast<uint32_t>(generator()) & mask;
  return words;
}

// Returns `count` elements and 16 more, which kernels may read.
std::vector<uint32_t> permutation(uint32_t count, bool shuffled) {
  std::vector<uint32_t> order(size_t{count} + 16);
  std::iota(order.begin(), order.end(), 0u);
  std::mt19937 generator(1);
  if (shuffled) std::shuffle(order.begin(), order.begin() + count, generator);
  return order;
}

class SmallKernels {
 public:
  SmallKernels(KernelRows& rows, gpu::Context& context, uint32_t n)
      : rows_(rows), context_(context), n_(n), checked_(std::min(n, most_checked)) {}

  void run() {
    if (rows_.wants("curves/encode") || rows_.wants("curves/decode"))
      for (const char* name : {"morton2", "morton3", "morton5", "hilbert2", "hilbert3"}) curves(name);
    if (rows_.wants("gather_rays/gather_rays"))
      for (const bool shuffled : {false, true}) gather(shuffled);
    if (rows_.wants("generate_rays/generate_rays") || rows_.wants("generate_rays/generate_ordered"))
      for (const Directions map : std::to_array<Directions>({"horizon", "hilbert", "fibonacci", "random"}))
        generate(map);
    if (rows_.wants("generate_rays/generate_launchers")) generate_together();
    if (rows_.wants("order_keys/launch_keys") || rows_.wants("order_keys/queue_keys"))
      for (const auto& [key, name] : {std::pair{OrderKey::morton, "morton"},
                                      {OrderKey::morton_bins, "morton-histogram"},
                                      {OrderKey::hilbert_bins, "hilbert3d-histogram"},
                                      {OrderKey::direction_origin, "direction-origin"}})
        order_keys(key, name);
    if (rows_.wants("scan/scan") || rows_.wants("scan/scan_sums")) scan();
    if (rows_.wants("compact/count_blocks") || rows_.wants("compact/compact")) compact();
  }

 private:
  KernelRows& rows_;
  gpu::Context& context_;
  uint32_t n_, checked_;

  // Returns a case of one kernel that takes every element once.
  KernelCase one(const char* kernel, const std::string& variant, const char* element, const KernelWork& work,
                 std::function<void()> run, std::function<size_t()> wrong) const {
    return {.variant =
                fmt::format("{}, n = {}", variant,
                            std::has_single_bit(n_) ? fmt::format("2^{}", std::countr_zero(n_)) : std::to_string(n_)),
            .kernels = {{kernel, {element, static_cast<double>(n_), work}}},
            .run = std::move(run),
            .wrong = std::move(wrong)};
  }

  template <class T>
  size_t differing(const std::vector<T>& a, const std::vector<T>& b) const {
    size_t count = 0;
    for (size_t i = 0; i < std::min<size_t>(a.size(), checked_); i++) count += a[i] != b[i];
    return count;
  }

  // Decoding must undo encoding.
  void curves(const std::string& name) {
    Curve curve(context_, name);
    const uint32_t planes = curve.dimensions();
    const auto words = random_words(size_t{n_} * planes, ~0u >> (32 - curve.bits()));
    auto points = context_.buffer(words, "points"), decoded = context_.buffer<uint32_t>(words.size(), "decoded");
    auto codes = context_.buffer<uint64_t>(n_, "codes");
    curve.encode(points, n_, n_, codes);
    curve.decode(codes, n_, decoded, n_);
    const auto wrong = [&] {
      size_t count = 0;
      for (size_t plane = 0; plane < planes; plane++)
        count += differing(points.read(plane * n_, checked_), decoded.read(plane * n_, checked_));
      return count;
    };
    const double bytes = 4.0 * planes + 8;
    rows_.measure(context_, one(
                                "curves/encode", name, "points", {.bytes = bytes},
                                [&] { curve.encode(points, n_, n_, codes); }, wrong));
    rows_.measure(context_, one(
                                "curves/decode", name, "codes", {.bytes = bytes},
                                [&] { curve.decode(codes, n_, decoded, n_); }, wrong));
  }

  RayQueue launch(Directions map) {
    RayQueue rays = make_ray_queue(context_, n_, "rays");
    GenerateRays(context_, LaunchDirections(map, n_, seed))(rays, {0, {0, 0, 0}}, 0, n_);
    return rays;
  }

  void gather(bool shuffled) {
    GatherRays gather(context_);
    const RayQueue rays = launch("random");
    RayQueue next = make_ray_queue(context_, n_, "next rays");
    const std::vector<uint32_t> order = permutation(n_, shuffled);
    const auto list = context_.buffer(order, "order");
    const auto wrong = [&] {
      size_t count = 0;
      for (size_t plane = 0; plane < WT_RAY_PLANES; plane++) {
        const auto from = rays.planes.read(plane * rays.capacity, n_);
        const auto to = next.planes.read(plane * next.capacity, checked_);
        for (size_t i = 0; i < checked_; i++)
          count += std::bit_cast<uint32_t>(to[i]) != std::bit_cast<uint32_t>(from[order[i]]);
      }
      return count;
    };
    const KernelWork work{.bytes = 8.0 * WT_RAY_PLANES + 4, .gathers = shuffled ? 1.0 * WT_RAY_PLANES : 0};
    rows_.measure(context_, one(
                                "gather_rays/gather_rays", shuffled ? "random permutation" : "identity", "rays", work,
                                [&] { gather(rays, list, rays.count, next); }, wrong));
  }

  // Counts directions that differ from those of the host, which evaluates the same header.
  size_t wrong_directions(const RayQueue& rays, const std::vector<uint32_t>& order, const LaunchDirections& d) {
    const std::vector<float> heights = LaunchHeights(context_).values();
    const auto place = d.places == "wt_place_hilbert"     ? device::wt_place_hilbert
                       : d.places == "wt_place_fibonacci" ? device::wt_place_fibonacci
                                                          : device::wt_place_random;
    const size_t checked = std::min(rays.count, checked_);
    std::vector<float> x, y, z;
    for (const auto& [plane, axis] : {std::pair{&x, 0u}, {&y, 1u}, {&z, 2u}})
      *plane = rays.planes.read((WT_RAY_DIRECTION + axis) * size_t{rays.capacity}, checked);
    size_t count = 0;
    for (size_t i = 0; i < checked; i++) {
      uint32_t height, turn;
      place(order[i], d.parameter, d.level, d.faces, &height, &turn);
      const device::wt_direction expected = device::wt_spread(height, turn, d.by_table, heights.data(), 0);
      count += x[i] != expected.x || y[i] != expected.y || z[i] != expected.z;
    }
    return count;
  }

  void generate(Directions map) {
    const LaunchDirections directions(map, n_, seed);
    GenerateRays generate(context_, directions);
    RayQueue rays = make_ray_queue(context_, n_, "rays");
    const double bytes = 4.0 * WT_RAY_PLANES;
    for (const bool listed : {false, true}) {
      const std::vector<uint32_t> order = permutation(n_, listed);
      const auto list = context_.buffer(order, "order");
      const auto run = [&] {
        rays.count = 0;
        if (listed)
          generate(rays, {0, {0, 0, 0}}, 0, n_, list);
        else
          generate(rays, {0, {0, 0, 0}}, 0, n_);
      };
      rows_.measure(context_, one(listed ? "generate_rays/generate_ordered" : "generate_rays/generate_rays",
                                  fmt::format("{}, {}", map.word(), listed ? "random list" : "in order"), "rays",
                                  {.bytes = bytes + (listed ? 4 : 0), .operations = 20}, run,
                                  [&] { return wrong_directions(rays, order, directions); }));
    }
  }

  // Every second direction of one launch for each of two transmitters; the first must have those of the host.
  void generate_together() {
    const LaunchDirections directions("hilbert", n_, seed);
    GenerateRays generate(context_, directions);
    RayQueue rays = make_ray_queue(context_, n_, "rays");
    const std::array<Launcher, 2> launchers{{{0, {0, 0, 0}}, {1, {1, 2, 3}}}};
    const uint32_t each = n_ / 2 / generate.rays_together() * generate.rays_together();
    std::vector<uint32_t> order(n_);
    for (uint32_t i = 0; i < n_; i++) order[i] = i < each ? 2 * i : 0;
    const auto wrong = [&] {
      RayQueue first = rays;
      first.count = std::min(each, checked_);
      return wrong_directions(first, order, directions);
    };
    KernelCase c = one(
        "generate_rays/generate_launchers", "hilbert, two transmitters", "rays",
        {.bytes = 4.0 * WT_RAY_PLANES, .operations = 20},
        [&] {
          rays.count = 0;
          generate(rays, launchers, 0, each, 2);
        },
        wrong);
    c.kernels.begin()->second.elements = 2.0 * each;
    rows_.measure(context_, c);
  }

  // Keys of launch indices must equal those of the rays; with direction-origin they may differ in the lowest bits: 4 of
  // finer directions in the one, 12 of origins in the other.
  void order_keys(OrderKey key, const std::string& name) {
    const LaunchDirections directions("random", n_, seed);
    OrderKeys keys_of(context_, key, 16, directions, 1);
    const RayQueue rays = launch("random");
    auto of_launch = context_.buffer<uint32_t>(size_t{n_} + 16, "keys of the launch");
    auto of_queue = context_.buffer<uint32_t>(size_t{n_} + 16, "keys of the queue");
    keys_of(0, n_, of_launch);
    keys_of(rays, of_queue);
    const auto without = [&](const gpu::Buffer<uint32_t>& keys, unsigned lowest_bits) {
      std::vector<uint32_t> words = keys.read(0, checked_);
      if (key == OrderKey::direction_origin)
        for (uint32_t& word : words) word >>= lowest_bits;
      return words;
    };
    const auto wrong = [&] { return differing(without(of_launch, 4), without(of_queue, 12)); };
    rows_.measure(context_, one(
                                "order_keys/launch_keys", name, "rays", {.bytes = 4, .operations = 30},
                                [&] { keys_of(0, n_, of_launch); }, wrong));
    const double ray_bytes = key == OrderKey::direction_origin ? 24 : 12;
    rows_.measure(context_, one(
                                "order_keys/queue_keys", name, "rays", {.bytes = ray_bytes + 4, .operations = 30},
                                [&] { keys_of(rays, of_queue); }, wrong));
  }

  void scan() {
    Scan scan(context_);
    const std::vector<uint32_t> words = random_words(n_, 0xFFu);
    std::vector<uint32_t> expected(n_);
    const auto host_scan = [&] {
      return wall_seconds(
          [&] { std::exclusive_scan(std::execution::par, words.begin(), words.end(), expected.begin(), 0u); });
    };
    host_scan();
    std::vector<double> theirs;
    for (size_t run = 0; run < rows_.runs(); run++) theirs.push_back(host_scan());
    const auto given = context_.buffer(words, "given counts");
    auto counts = context_.buffer<uint32_t>(n_, "counts");
    KernelCase c = one(
        "scan/scan", "random counts", "counts", {.bytes = 8, .operations = 1}, [&] { scan(counts, n_); },
        [&] { return differing(counts.read(0, checked_), expected); });
    c.kernels["scan/scan_sums"] = {"counts", static_cast<double>(n_), {.bytes = 4, .operations = 1}};
    c.prepare = [&] { context_.copy(given, counts, given.bytes()); };
    if (context_.info().cpu)
      c.remark = fmt::format("std::exclusive_scan, std::execution::par: {:.4g} ms", median(theirs) * 1e3);
    rows_.measure(context_, c);
  }

  // Half of the words are live.
  void compact() {
    const uint32_t block = tuning_of(context_.info()).block;
    Compact compact(context_);
    std::vector<float> words(n_);
    std::vector<uint32_t> alive;
    const std::vector<uint32_t> coin = random_words(n_, 1);
    for (uint32_t i = 0; i < n_; i++) {
      words[i] = std::bit_cast<float>(coin[i] ? WT_NONE : i);
      if (!coin[i]) alive.push_back(i);
    }
    const auto planes = context_.buffer(words, "words");
    const uint32_t blocks = (n_ + block - 1) / block;
    auto counts = context_.buffer<uint32_t>(blocks, "block counts");
    auto offsets = context_.buffer<uint32_t>(blocks, "block offsets");
    auto indices = context_.buffer<uint32_t>(n_, "indices");
    compact.count_blocks(planes, 0, n_, counts);
    context_.copy(counts, offsets, counts.bytes());
    Scan scan_blocks(context_);
    scan_blocks(offsets, blocks);
    compact(planes, 0, n_, offsets, indices);
    const auto wrong = [&] { return differing(indices.read(0, std::min<size_t>(alive.size(), checked_)), alive); };
    const double block_bytes = 4.0 / block;
    rows_.measure(context_, one(
                                "compact/count_blocks", "half alive", "words", {.bytes = 4 + block_bytes},
                                [&] { compact.count_blocks(planes, 0, n_, counts); }, wrong));
    const double kept_bytes = 4.0 * static_cast<double>(alive.size()) / n_;
    rows_.measure(context_, one(
                                "compact/compact", "half alive", "words", {.bytes = 4 + kept_bytes + block_bytes},
                                [&] { compact(planes, 0, n_, offsets, indices); }, wrong));
  }
};

}  // namespace

void measure_small_kernels(KernelRows& rows, gpu::Context& context, uint32_t n) {
  SmallKernels(rows, context, n).run();
}

}  // namespace wavetracer::bench
