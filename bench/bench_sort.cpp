// SPDX-License-Identifier: Apache-2.0
// bench_sort measures our sorts of random keys and compares them with those of C++, TBB, Highway and Boost.Compute in
// the same run, and with those of CUDA if --cub names a program for them. The machine must be quiet. The value is wall
// time, including launches; "error" counts keys and values that are not where std::stable_sort puts them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <bit>

#ifdef WAVETRACER_BOOST
#include "boost_peer.hpp"
#endif
#include "device_sort.hpp"
#include "json_line.hpp"
#include "sort_peers.hpp"
#include "sort_variants.hpp"
#include "timing.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

constexpr uint32_t most_for_bitonic = 1u << 22;
constexpr uint32_t most_for_slow_peers = 1u << 22;  // on CPUs; with more, a run takes a second or longer

struct Options {
  std::string device, cub;
  size_t runs = 7;
  unsigned largest = 0;  // a power of two; 0 means one that suits the device
  bool peers = true, variants = false;
  VariantOptions tunings;
};

struct Case {
  SortShape shape;
  bool crossover = false;  // few keys: only our two sorts
};

// 12 bits are the keys of the thesis' histogram, 24 those of direction-origin, 40 a key packed with an index of 24.
std::vector<Case> all_cases(unsigned largest) {
  std::vector<Case> cases;
  for (unsigned power = 8; power <= std::min(16u, largest); power++)
    cases.push_back({{32, true, 1u << power, 32}, true});
  for (const unsigned power : {17u, 18u, 20u, 22u, 24u, 26u}) {
    if (power > largest) break;
    const uint32_t n = 1u << power;
    for (const unsigned key_bits : {32u, 64u})
      for (const bool payload : {true, false}) cases.push_back({{key_bits, payload, n, key_bits}});
    cases.push_back({{32, true, n, 12}});
    cases.push_back({{32, true, n, 24}});
    cases.push_back({{64, true, n, 40}});
  }
  return cases;
}

std::string label(const SortShape& shape, Payload payload) {
  std::string text = fmt::format("u{}", shape.key_bits);
  if (shape.bits < shape.key_bits) text += fmt::format(" of {} bits", shape.bits);
  if (payload != Payload::none) text += payload == Payload::words ? " + u32" : " to permutation";
  return fmt::format("{}, n = 2^{}", text, std::countr_zero(shape.n));
}

bool full_width(const SortShape& shape) { return shape.bits == shape.key_bits; }

// label: its name in the case, the same in every run.
struct Baseline {
  std::string name;
  double seconds = 0;
  std::string label = {};
};
using Baselines = std::vector<Baseline>;

class Bench {
 public:
  Bench(const Options& options, std::string command)
      : options_(options),
        command_(std::move(command)),
        context_(options.device),
        copy_(copy_bandwidth(context_, options.runs)) {}

  void run() {
    const std::vector<Case> cases = all_cases(options_.largest ? options_.largest : context_.info().cpu ? 24 : 26);
    if (!options_.cub.empty()) {
      std::vector<SortShape> shapes;
      for (const Case& c : cases)
        if (!c.crossover) shapes.push_back(c.shape);
      cub_ = run_program(options_.cub, shapes, options_.runs);
    }
    for (const Case& c : cases) {
      if (c.shape.key_bits == 32)
        measure<uint32_t>(c);
      else
        measure<uint64_t>(c);
    }
  }

 private:
  const Options& options_;
  std::string command_;
  gpu::Context context_;
  double copy_;  // bytes per second
  ProgramTimes cub_;

  struct Measured {
    std::string name;
    SortShape shape;
    double model_bytes;
    SortSeconds seconds;
    size_t wrong;
  };

  // Returns the peers that could complete one run, which is not counted.
  template <class Key>
  std::vector<SortPeer> warm_peers(const SortShape& shape, const std::vector<Key>& keys) const {
    if (!options_.peers) return {};
    const bool cpu = context_.info().cpu;
    const bool slow = full_width(shape) && (!cpu || shape.n <= most_for_slow_peers);
    std::vector<SortPeer> peers;
    if (cpu) peers = host_peers(keys, shape.payload, slow);
#ifdef WAVETRACER_BOOST
    if (slow) peers.push_back(boost_peer(context_.info(), keys, shape.payload));
#endif
    std::erase_if(peers, [](SortPeer& peer) {
      try {
        peer.run();
        return false;
      } catch (const RuntimeError& error) {
        fmt::print(stderr, "bench_sort: {}; there is no such baseline here\n", error.what());
        return true;
      }
    });
    return peers;
  }

  template <class Key>
  void measure(const Case& c) {
    using Sort = typename DeviceKeys<Key>::Sort;
    DeviceKeys<Key> keys(context_, keys_of_bits<Key>(c.shape.n, c.shape.bits), c.shape.bits);
    std::vector<Sort> sorts;
    if (c.shape.payload) sorts.push_back(keys.radix(Payload::index));  // first: bitonic is compared with it
    if (!c.crossover) sorts.push_back(keys.radix(c.shape.payload ? Payload::words : Payload::none));
    if (c.shape.payload && full_width(c.shape) && c.shape.n <= most_for_bitonic)
      sorts.push_back(keys.bitonic(Payload::index));
    std::vector<SortPeer> peers;
    if (!c.crossover) peers = warm_peers(c.shape, keys.keys());

    std::vector<size_t> wrong;
    for (const Sort& sort : sorts) {
      keys.run(sort);  // warm-up
      wrong.push_back(keys.wrong(sort));
    }
    // Rounds go over all of them, so that a slow phase of the machine slows them all.
    std::vector<std::vector<double>> wall(sorts.size()), device(sorts.size()), theirs(peers.size());
    for (size_t run = 0; run < options_.runs; run++) {
      for (size_t i = 0; i < sorts.size(); i++) {
        const SortSeconds seconds = keys.run(sorts[i]);
        wall[i].push_back(seconds.wall);
        device[i].push_back(seconds.device);
      }
      for (size_t i = 0; i < peers.size(); i++) theirs[i].push_back(peers[i].run());
    }

    Baselines baselines;
    if (const auto found = cub_.find(c.shape); found != cub_.end())
      for (const auto& [name, seconds] : found->second) baselines.push_back({name, seconds});
    for (size_t i = 0; i < peers.size(); i++) baselines.push_back({peers[i].name, median(theirs[i])});
    for (Baseline& baseline : baselines) baseline.label = baseline.name;
    Baselines fastest;
    if (!baselines.empty())
      fastest = {*std::min_element(baselines.begin(), baselines.end(),
                                   [](const Baseline& a, const Baseline& b) { return a.seconds < b.seconds; })};
    for (Baseline& baseline : fastest) baseline.label = "the fastest peer";
    const Baselines radix{{"our radix sort", median(wall[0]), "our radix sort"}};
    for (size_t i = 0; i < sorts.size(); i++) {
      const Sort& sort = sorts[i];
      const bool every_peer = full_width(c.shape) && sort.payload != Payload::index;
      print_case({label(c.shape, sort.payload) + ": " + sort.name,
                  c.shape,
                  sort.model_bytes,
                  {median(wall[i]), median(device[i])},
                  wrong[i]},
                 sort.model_bytes == 0 ? radix
                 : every_peer          ? baselines
                                       : fastest);
    }
  }

  // Prints one line per baseline, or one without a baseline if there is none.
  void print_case(const Measured& m, const Baselines& baselines) const {
    const double n = m.shape.n, bytes_a_second = m.model_bytes * n / m.seconds.device;
    Result result;
    result.bench = "sort";
    result.name = m.name;
    result.device = context_.info().name;
    result.value = n / m.seconds.wall * 1e-9;
    result.unit = "Gkeys/s";
    result.error = static_cast<double>(m.wrong);
    result.exact = true;
    result.detail = fmt::format("{:.4g} us, {:.4g} us in kernels", m.seconds.wall * 1e6, m.seconds.device * 1e6);
    result.extra = {{"n", m.shape.n},           {"key_bits", m.shape.key_bits},  {"sorted_bits", m.shape.bits},
                    {"wall_s", m.seconds.wall}, {"kernels_s", m.seconds.device}, {"copy_gb_s", copy_ * 1e-9}};
    if (m.model_bytes > 0) {
      result.detail +=
          fmt::format("; {:.0f} B per key, {:.0f}% of the copy", m.model_bytes, 100 * bytes_a_second / copy_);
      result.extra.update({{"model_bytes", m.model_bytes},
                           {"model_gb_s", bytes_a_second * 1e-9},
                           {"copy_fraction", bytes_a_second / copy_}});
    }
    if (baselines.empty()) print(result, command_);
    for (const Baseline& baseline : baselines) {
      result.name = m.name + ", against " + baseline.label;
      result.baseline = baseline.name;
      result.baseline_value = n / baseline.seconds * 1e-9;
      result.extra["kernels_ratio"] = baseline.seconds / m.seconds.device;
      print(result, command_);
    }
  }
};

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Our sorts over random keys, beside those of C++, TBB, Highway, Boost.Compute and CUDA");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--runs", options.runs, "timed runs of which the median counts")->check(CLI::Range(7, 1000));
  app.add_option("--largest", options.largest, "most keys, as a power of two; default: 24 on CPUs, 26 elsewhere")
      ->check(CLI::Range(8, 28));
  app.add_option("--cub", options.cub, "the program built of bench/peers/cub_sort.cu");
  app.add_flag("!--no-peers", options.peers, "leave out all peers but that of --cub");
  app.add_flag("--variants", options.variants,
               "only the radix sort by groups, with every tuning of the options below, beside CUB if --cub is given");
  bench::VariantOptions& tunings = options.tunings;
  const auto list = [&](const char* name, auto& values, const char* text) {
    return app.add_option(name, values, text)->delimiter(',')->capture_default_str()->group("With --variants");
  };
  list("--powers", tunings.powers, "of two: numbers of keys")->check(CLI::Range(8, 28));
  list("--shapes", tunings.shapes, "keys, with a word each or without")
      ->check(CLI::IsMember({"u32", "u32+u32", "u64", "u64+u32"}));
  list("--ranks", tunings.ranks, "ways to rank")->check(CLI::IsMember({"columns", "masks", "votes", "match"}));
  list("--items", tunings.items, "work-items of a group")->check(CLI::Range(64, 1024));
  list("--item-keys", tunings.item_keys, "keys of a work-item")->check(CLI::Range(1, 64));
  list("--columns", tunings.columns, "for the ranks by columns")->check(CLI::Range(2, 256));
  list("--late", tunings.late, "1: values are read late")->check(CLI::Range(0, 1));
  list("--windows", tunings.windows, "earlier tiles looked at together")->check(CLI::Range(1, 32));
  list("--looks", tunings.looks, "in vain until a group counts an earlier tile itself");
  list("--registers", tunings.registers, "most registers of a work-item; 0: the compiler's choice");
  list("--tickets", tunings.tickets, "1: groups take the next tile, 0: that of their number")->check(CLI::Range(0, 1));
  list("--count-groups", tunings.count_groups, "groups that count")->check(CLI::Range(1, 1 << 20));
  CLI11_PARSE(app, argc, argv);
  try {
    const std::string command = bench::command_line(argc, argv);
    tunings.device = options.device;
    tunings.cub = options.cub;
    tunings.runs = options.runs;
    tunings.largest = options.largest;
    if (options.variants)
      bench::measure_sort_variants(tunings, command);
    else
      bench::Bench(options, command).run();
  } catch (const Error& error) {
    fmt::print(stderr, "bench_sort: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
