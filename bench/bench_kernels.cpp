// SPDX-License-Identifier: Apache-2.0
// bench_kernels measures the throughput of every small kernel of the suite, and its share of the memory limit: the
// bytes that an element must move, at the rate of the device's own copy in the same run. The machine must be quiet.
// Times are those of the kernels by the device's clock; "error" counts wrong elements among the first 2^20.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <bit>
#include <execution>
#include <functional>
#include <numeric>
#include <random>

#include "json_line.hpp"
#include "passes/compact.hpp"
#include "passes/curves.hpp"
#include "passes/gather_rays.hpp"
#include "passes/generate_rays.hpp"
#include "passes/order_keys.hpp"
#include "passes/scan.hpp"
#include "timing.hpp"
#include "wavetracer/device/directions.h"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

constexpr uint32_t most_checked = 1u << 20;
constexpr uint64_t seed = 1;

struct Options {
  std::string device;
  size_t runs = 7;
  uint32_t n = 0;  // 0 means a number that suits the device
};

struct KernelCase {
  std::string name;
  double bytes;  // bytes that an element must move, read and written
  std::function<void()> run;
  std::function<size_t()> wrong;          // counts errors after a run
  std::function<void()> prepare = [] {};  // not timed
  std::function<double()> baseline = {};  // seconds of the host's own implementation
  std::string baseline_name = {};
};

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

class Suite {
 public:
  Suite(const Options& options, std::string command)
      : options_(options),
        command_(std::move(command)),
        context_(options.device),
        n_(options.n ? options.n : 1u << (context_.info().cpu ? 22 : 26)),
        checked_(std::min(n_, most_checked)),
        copy_(copy_bandwidth(context_, options.runs)) {}

  // Each part frees its buffers before the next one allocates its own.
  void run() {
    for (const char* name : {"morton2", "morton3", "morton5", "hilbert2", "hilbert3"}) curves(name);
    for (const bool shuffled : {false, true}) gather(shuffled);
    for (const Directions map : std::to_array<Directions>({"horizon", "hilbert", "fibonacci", "random"})) generate(map);
    for (const auto& [key, name] : {std::pair{OrderKey::morton, "morton"},
                                    {OrderKey::morton_bins, "morton-histogram"},
                                    {OrderKey::hilbert_bins, "hilbert3d-histogram"},
                                    {OrderKey::direction_origin, "direction-origin"}})
      order_keys(key, name);
    scan();
    compact();
  }

 private:
  const Options& options_;
  std::string command_;
  gpu::Context context_;
  uint32_t n_, checked_;
  double copy_;  // bytes per second

  void measure(const KernelCase& c) {
    const auto once = [&] {
      c.prepare();
      context_.finish();
      context_.reset_profile();
      c.run();
      return device_seconds(context_);
    };
    once();  // warm-up
    const size_t wrong = c.wrong();
    std::vector<double> ours, theirs;
    for (size_t run = 0; run < options_.runs; run++) {
      ours.push_back(once());
      if (c.baseline) theirs.push_back(c.baseline());
    }
    const double seconds = median(ours), fraction = c.bytes * n_ / seconds / copy_;
    Result result;
    result.bench = "kernels";
    result.name = fmt::format("{}, n = {}", c.name,
                              std::has_single_bit(n_) ? fmt::format("2^{}", std::countr_zero(n_)) : std::to_string(n_));
    result.device = context_.info().name;
    result.value = n_ / seconds * 1e-9;
    result.unit = "Gelements/s";
    result.error = static_cast<double>(wrong);
    result.exact = true;
    result.detail = fmt::format("{:.4g} B per element, {:.0f}% of the copy", c.bytes, 100 * fraction);
    result.extra = {{"n", n_},
                    {"kernels_s", seconds},
                    {"element_bytes", c.bytes},
                    {"gb_s", c.bytes * n_ / seconds * 1e-9},
                    {"copy_gb_s", copy_ * 1e-9},
                    {"copy_fraction", fraction}};
    if (c.baseline) {
      result.baseline = c.baseline_name;
      result.baseline_value = n_ / median(theirs) * 1e-9;
    }
    print(result, command_);
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
    measure({name + " encode", bytes, [&] { curve.encode(points, n_, n_, codes); }, wrong});
    measure({name + " decode", bytes, [&] { curve.decode(codes, n_, decoded, n_); }, wrong});
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
    measure({fmt::format("gather_rays, {}", shuffled ? "random permutation" : "identity"), 8.0 * WT_RAY_PLANES + 4,
             [&] { gather(rays, list, rays.count, next); }, wrong});
  }

  // Counts directions that differ from those of the host, which evaluates the same header.
  size_t wrong_directions(const RayQueue& rays, const std::vector<uint32_t>& order, const LaunchDirections& d) {
    const std::vector<float> heights = LaunchHeights(context_).values();
    const auto place = d.places == "wt_place_hilbert"     ? device::wt_place_hilbert
                       : d.places == "wt_place_fibonacci" ? device::wt_place_fibonacci
                                                          : device::wt_place_random;
    std::vector<float> x, y, z;
    for (const auto& [plane, axis] : {std::pair{&x, 0u}, {&y, 1u}, {&z, 2u}})
      *plane = rays.planes.read((WT_RAY_DIRECTION + axis) * size_t{rays.capacity}, checked_);
    size_t count = 0;
    for (size_t i = 0; i < checked_; i++) {
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
      measure({fmt::format("generate_rays {}, {}", map.word(), listed ? "random list" : "in order"),
               bytes + (listed ? 4 : 0), run, [&] { return wrong_directions(rays, order, directions); }});
    }
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
    measure({fmt::format("order_keys {}, launch", name), 4, [&] { keys_of(0, n_, of_launch); }, wrong});
    const double ray_bytes = key == OrderKey::direction_origin ? 24 : 12;
    measure({fmt::format("order_keys {}, queue", name), ray_bytes + 4, [&] { keys_of(rays, of_queue); }, wrong});
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
    const auto given = context_.buffer(words, "given counts");
    auto counts = context_.buffer<uint32_t>(n_, "counts");
    KernelCase c{"scan", 8, [&] { scan(counts, n_); }, [&] { return differing(counts.read(0, checked_), expected); },
                 [&] { context_.copy(given, counts, given.bytes()); }};
    if (context_.info().cpu) {
      c.baseline = host_scan;
      c.baseline_name = "std::exclusive_scan, std::execution::par";
    }
    measure(c);
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
    measure({"compact, count", 4 + block_bytes, [&] { compact.count_blocks(planes, 0, n_, counts); }, wrong});
    measure({"compact, half alive", 4 + 4.0 * static_cast<double>(alive.size()) / n_ + block_bytes,
             [&] { compact(planes, 0, n_, offsets, indices); }, wrong});
  }
};

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Throughput of the kernels of curves, orders, launches, scans and compaction");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--runs", options.runs, "timed runs of which the median counts")->check(CLI::Range(7, 1000));
  app.add_option("--n", options.n, "elements; default: 2^22 on CPUs, 2^26 elsewhere")->check(CLI::Range(1, 1 << 28));
  CLI11_PARSE(app, argc, argv);
  try {
    bench::Suite(options, bench::command_line(argc, argv)).run();
  } catch (const Error& error) {
    fmt::print(stderr, "bench_kernels: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
