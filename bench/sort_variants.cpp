// SPDX-License-Identifier: Apache-2.0
// The multiprocessor of a GPU shares 64 Ki registers and 228 KiB of local memory (sm_90) among the groups that it
// holds, so the largest tiles are not always the fastest.
#include "sort_variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <set>
#include <vector>

#include "device_sort.hpp"
#include "json_line.hpp"
#include "sort_peers.hpp"
#include "timing.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

constexpr const char* rank_names[] = {"columns", "masks", "votes", "match"};

std::string name_of(const RadixTuning& t) {
  return fmt::format("{}, {} items, {} keys each{}{}, window {}, {} looks, registers {}, {} counting groups{}",
                     rank_names[static_cast<int>(t.ranks)], t.items, t.item_keys,
                     t.ranks == RadixRanks::columns ? fmt::format(", {} columns", t.columns) : "",
                     t.late_values ? ", late values" : "", t.window, t.looks, t.registers, t.count_groups,
                     t.tickets ? "" : ", no tickets");
}

// The local memory of `move`: counters or keys, what the ranking needs besides, two words for each of 256 digits.
size_t local_bytes(const RadixTuning& t, size_t key_bytes) {
  const size_t warps = t.items / 32, columns = t.ranks == RadixRanks::columns ? t.columns : 0;
  const size_t counters = 1024 * warps * (columns == 0) + 512 * (columns + 2) * (columns > 0);
  const size_t more = columns > 0 ? t.tile() + 4 * columns : t.ranks == RadixRanks::masks ? 1024 * warps : 4;
  return std::max(t.tile() * key_bytes, counters) + more + 2056;
}

// The tunings that the device has the local memory for.
std::vector<RadixTuning> tunings_of(const VariantOptions& o, const gpu::DeviceInfo& device, size_t key_bytes,
                                    bool payload) {
  std::vector<RadixTuning> found;
  const auto add = [&](RadixTuning t) {
    const uint32_t c = t.columns;
    const bool columns = t.tile() % c == 0 && c <= t.items && t.tile() / c <= 256 && t.tile() / c % 4 == 0;
    if (t.ranks == RadixRanks::columns && !columns) return;
    if (local_bytes(t, key_bytes) <= device.local_memory && t.items <= device.max_work_group) found.push_back(t);
  };
  for (const std::string& ranks : o.ranks)
    for (const uint32_t items : o.items)
      for (const uint32_t item_keys : o.item_keys)
        for (const uint32_t columns : ranks == "columns" ? o.columns : std::vector<uint32_t>{72})
          for (const unsigned late : payload ? o.late : std::vector<unsigned>{0})
            for (const uint32_t window : o.windows)
              for (const uint32_t looks : o.looks)
                for (const uint32_t registers : o.registers)
                  for (const uint32_t groups : o.count_groups)
                    for (const unsigned tickets : o.tickets)
                      add({.items = items,
                           .item_keys = item_keys,
                           .ranks = static_cast<RadixRanks>(std::ranges::find(rank_names, ranks) - rank_names),
                           .columns = columns,
                           .late_values = late != 0,
                           .window = window,
                           .looks = looks,
                           .registers = registers,
                           .count_groups = groups,
                           .tickets = tickets != 0});
  return found;
}

class Variants {
 public:
  Variants(const VariantOptions& options, const std::string& command)
      : options_(options), command_(command), context_(options.device) {}

  void run() {
    std::vector<SortShape> shapes;
    for (const unsigned key_bits : {32u, 64u})
      for (const bool payload : {false, true})
        for (const unsigned power : options_.powers)
          if (wanted(key_bits, payload) && (options_.largest == 0 || power <= options_.largest))
            shapes.push_back({key_bits, payload, 1u << power, key_bits});
    if (!options_.cub.empty()) cub_ = run_program(options_.cub, shapes, options_.runs);
    for (const SortShape& shape : shapes) {
      if (shape.key_bits == 32)
        measure<uint32_t>(shape);
      else
        measure<uint64_t>(shape);
    }
  }

 private:
  const VariantOptions& options_;
  const std::string& command_;
  gpu::Context context_;
  ProgramTimes cub_;

  bool wanted(unsigned key_bits, bool payload) const {
    const std::string name = fmt::format("u{}{}", key_bits, payload ? "+u32" : "");
    return std::ranges::find(options_.shapes, name) != options_.shapes.end();
  }

  struct Times {
    std::vector<double> wall;
    std::map<std::string, std::vector<double>> kernels;
  };

  template <class Key>
  void measure(const SortShape& shape) {
    DeviceKeys<Key> keys(context_, keys_of_bits<Key>(shape.n, shape.bits), shape.bits);
    std::vector<RadixTuning> variants;
    std::vector<typename DeviceKeys<Key>::Sort> sorts;
    std::vector<size_t> wrong;
    typename DeviceKeys<Key>::Result first;
    for (const RadixTuning& tuning : tunings_of(options_, context_.info(), sizeof(Key), shape.payload)) {
      try {
        const auto sort = keys.radix(shape.payload ? Payload::words : Payload::none, tuning);
        keys.run(sort);  // warm-up
        if (sorts.empty()) first = keys.result(sort);
        wrong.push_back(sorts.empty() ? keys.wrong(sort) : keys.result(sort) != first);
        sorts.push_back(sort);
        variants.push_back(tuning);
      } catch (const Error& error) {
        fmt::print(stderr, "bench_sort: {}: {}\n", name_of(tuning), error.what());
      }
    }
    std::vector<Times> times(sorts.size());
    for (size_t run = 0; run < options_.runs; run++)
      for (size_t i = 0; i < sorts.size(); i++) {
        times[i].wall.push_back(keys.run(sorts[i]).wall);
        for (const auto& [kernel, time] : context_.kernel_times()) times[i].kernels[kernel].push_back(time.seconds);
      }
    for (size_t i = 0; i < sorts.size(); i++) print_variant(shape, variants[i], times[i], wrong[i]);
  }

  void print_variant(const SortShape& shape, const RadixTuning& v, const Times& times, size_t wrong) const {
    const double n = shape.n, wall = median(times.wall);
    Result result;
    result.bench = "sort_variants";
    result.name = fmt::format("u{}{}, n = 2^{}: {}", shape.key_bits, shape.payload ? " + u32" : "",
                              std::bit_width(shape.n) - 1, name_of(v));
    result.device = context_.info().name;
    result.value = n / wall * 1e-9;
    result.unit = "Gkeys/s";
    result.error = static_cast<double>(wrong);
    result.exact = true;
    result.detail = fmt::format("{:.4g} us;", wall * 1e6);
    for (const auto& [kernel, seconds] : times.kernels)
      result.detail += fmt::format(" {} {:.4g} us", kernel.substr(kernel.find('/') + 1), median(seconds) * 1e6);
    if (const auto found = cub_.find(shape); found != cub_.end())
      for (const auto& [name, seconds] : found->second)
        if (name == "CUB") {
          result.baseline = name;
          result.baseline_value = n / seconds * 1e-9;
        }
    print(result, command_);
  }
};

}  // namespace

void measure_sort_variants(const VariantOptions& options, const std::string& command) {
  Variants(options, command).run();
}

}  // namespace wavetracer::bench
