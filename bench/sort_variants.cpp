// SPDX-License-Identifier: Apache-2.0
// The multiprocessor of a GPU shares 64 Ki registers and 228 KiB of local memory (sm_90) among the groups that it
// holds. With 18 keys an item, `move` takes 77 to 128 registers of an item, so that the registers allow for two or
// three groups of 256 and the local memory for five (ptxas -v of the same source, nvcc 13.0). The tunings below have
// fewer keys per item, smaller tiles or fewer counters.
#include "sort_variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "device_sort.hpp"
#include "json_line.hpp"
#include "sort_peers.hpp"
#include "timing.hpp"

namespace wavetracer::bench {
namespace {

struct Variant {
  uint32_t items, tile, columns;
  bool together, late_values;
  uint32_t most_chunks = 1024;
};

constexpr Variant keys_alone[] = {{256, 4608, 72, false, false}, {384, 4608, 72, false, false},
                                  {384, 4608, 64, false, false}, {512, 4608, 72, false, false},
                                  {384, 4608, 36, false, false}, {256, 3072, 48, false, false},
                                  {512, 6144, 64, false, false}, {384, 4608, 72, false, false, 2048}};
constexpr Variant small_pairs[] = {
    {256, 4608, 72, true, false}, {256, 4608, 72, true, true},       {384, 4608, 64, true, true},
    {384, 4608, 36, true, false}, {512, 4608, 64, true, false},      {256, 3840, 60, true, true},
    {384, 3840, 60, true, false}, {256, 3072, 48, true, false},      {384, 2304, 36, true, false},
    {512, 5120, 64, true, false}, {384, 3840, 60, true, false, 2048}};
constexpr Variant large_pairs[] = {
    {256, 4608, 72, false, false}, {384, 4608, 72, false, false},      {512, 4608, 72, false, false},
    {512, 4608, 64, false, false}, {512, 4608, 72, false, true},       {256, 3072, 48, true, true},
    {384, 3072, 48, true, false},  {512, 3072, 48, true, false},       {256, 2304, 36, true, false},
    {384, 2304, 36, true, false},  {512, 4608, 72, false, false, 2048}};

std::string name_of(const Variant& v) {
  return fmt::format("{} items, tile {}, {} columns{}{}{}", v.items, v.tile, v.columns,
                     v.together ? ", values beside keys" : "", v.late_values ? ", late values" : "",
                     v.most_chunks == 1024 ? "" : fmt::format(", {} chunks", v.most_chunks));
}

// The local memory of `move`: counters or keys, digits of the columns, two words for each of 256 digits.
size_t local_bytes(const Variant& v, size_t key_bytes) {
  const size_t tile = v.tile * (key_bytes + (v.together ? 4 : 0)), counters = 256 * 2 * (v.columns + 2);
  return std::max(tile, counters) + v.columns * (v.tile / v.columns + 4) + 2048;
}

RadixTuning tuning_of_variant(const gpu::DeviceInfo& device, const Variant& v, uint32_t key_bytes) {
  RadixTuning tuning = radix_groups(device, key_bytes, 4);
  tuning.items = v.items;
  tuning.tile = v.tile;
  tuning.columns = v.columns;
  tuning.together = v.together;
  tuning.late_values = v.late_values;
  tuning.most_chunks = v.most_chunks;
  return tuning;
}

class Variants {
 public:
  Variants(const VariantOptions& options, const std::string& command)
      : options_(options), command_(command), context_(options.device) {}

  void run() {
    const unsigned largest = options_.largest ? options_.largest : context_.info().cpu ? 18 : 26;
    std::vector<SortShape> shapes;
    for (const unsigned key_bits : {32u, 64u})
      for (const bool payload : {false, true})
        for (unsigned power = std::min(20u, largest); power <= largest; power += 2)
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

  struct Times {
    std::vector<double> wall;
    std::map<std::string, std::vector<double>> kernels;
  };

  template <class Key>
  void measure(const SortShape& shape) {
    DeviceKeys<Key> keys(context_, keys_of_bits<Key>(shape.n, shape.bits), shape.bits);
    std::vector<Variant> variants;
    std::vector<typename DeviceKeys<Key>::Sort> sorts;
    std::vector<size_t> wrong;
    for (const Variant& v : shape.payload ? sizeof(Key) == 4 ? std::span<const Variant>(small_pairs) : large_pairs
                                          : std::span<const Variant>(keys_alone)) {
      if (local_bytes(v, sizeof(Key)) > context_.info().local_memory || v.items > context_.info().max_work_group)
        continue;
      try {
        const auto sort = keys.radix(shape.payload ? Payload::words : Payload::none,
                                     tuning_of_variant(context_.info(), v, sizeof(Key)));
        keys.run(sort);  // warm-up
        wrong.push_back(keys.wrong(sort));
        sorts.push_back(sort);
        variants.push_back(v);
      } catch (const DeviceError& error) {
        fmt::print(stderr, "bench_sort: {}: {}\n", name_of(v), error.what());
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

  void print_variant(const SortShape& shape, const Variant& v, const Times& times, size_t wrong) const {
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
