// SPDX-License-Identifier: Apache-2.0
// bench_cache_groups measures grouping the rays of a depth by their key (cache.innerframe) through an election in a
// table, and compares it with a lower bound of grouping by a sort: the sort of as many 64-bit keys with the rays'
// numbers, alone. It also prints the time of tracing the rays that follow others, which grouping saves.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <bit>

#include "cache_rays.hpp"
#include "gpu/gpu.hpp"
#include "json_line.hpp"
#include "passes/cache_groups.hpp"
#include "passes/radix_sort.hpp"
#include "passes/trace.hpp"
#include "timing.hpp"

namespace wavetracer::bench {
namespace {

struct Options {
  std::string device, shared = WAVETRACER_SHARED;
  uint32_t rays = 0, runs = 9;
};

// Seconds of one depth, medians; all of its rays miss the table.
struct GroupTimes {
  size_t rays = 0, groups = 0;
  double elect = 0, share = 0, sort = 0, trace = 0;
};

template <class Pass>
double median_seconds(gpu::Context& context, uint32_t runs, const Pass& pass) {
  std::vector<double> seconds;
  for (uint32_t run = 0; run <= runs; ++run) {
    const double once = pass();
    if (run > 0) seconds.push_back(once);  // the first run warms up
  }
  context.finish();
  return median(seconds);
}

template <class Pass>
double device_time(gpu::Context& context, const Pass& pass) {
  context.finish();
  context.reset_profile();
  pass();
  return device_seconds(context);
}

// Returns keys as a sort by hash would have them.
std::vector<uint64_t> sort_keys(const Segment& segment, const CacheTable& table) {
  std::vector<uint64_t> keys;
  for (size_t i = 0; i < segment.rays.size(); ++i) {
    const auto& d = segment.rays[i].direction;
    const uint64_t cells = device::wt_cache_cells(d[0], d[1], d[2], table.config.division);
    keys.push_back(device::wt_cache_hash(1, cells, segment.left[i], segment.surface[i], table.widths) |
                   device::wt_cache_tag(cells, segment.left[i]));
  }
  return keys;
}

GroupTimes group_times(gpu::Context& context, const SceneRays& scene_rays, const Segment& segment,
                       const CacheConfig& config, uint32_t runs) {
  CacheTable table = make_cache_table(context, config, 1, static_cast<uint32_t>(scene_rays.scene.surfaces.size()),
                                      static_cast<uint32_t>(scene_rays.scene.triangles.size()));
  const DeviceScene scene = make_device_scene(context, scene_rays.scene, false);
  Trace trace(context, scene, context.info().cpu ? TraceShape::packet16 : TraceShape::bvh2);
  CacheGroups groups(context, table);
  RayQueue rays = labelled_queue(context, segment);
  HitList hits = make_hit_list(context, rays.count);
  std::vector<float> every(rays.capacity);
  for (uint32_t i = 0; i < every.size(); ++i) every[i] = std::bit_cast<float>(i);
  auto missed = context.buffer(every, "missed"), refused = context.buffer<float>(rays.capacity, "refused");
  groups.reserve(rays.capacity);
  GroupTimes out{.rays = rays.count};
  out.elect = median_seconds(context, runs, [&] {
    missed.write(every);
    return device_time(context, [&] { groups.elect(rays, missed, rays.count, table, WT_NONE); });
  });
  for (const uint32_t from : groups.representatives().read(0, rays.count)) out.groups += from == WT_NONE;
  out.trace = median_seconds(context, runs, [&] { return device_time(context, [&] { trace(scene, rays, hits); }); });
  out.share = median_seconds(context, runs, [&] {
    return device_time(context, [&] { groups.share(scene, rays, hits, missed, refused, table, 1); });
  });
  RadixSort<uint64_t> sort(context, Payload::index);
  const std::vector<uint64_t> unsorted = sort_keys(segment, table);
  auto keys = context.buffer(unsorted, "keys");
  auto values = context.buffer<uint32_t>(rays.count, "values");
  auto temporary = context.buffer<uint32_t>(sort.temporary_words(rays.count), "temporary");
  out.sort = median_seconds(context, runs, [&] {
    keys.write(unsorted);
    return device_time(context, [&] { sort(keys, values, rays.count, temporary); });
  });
  return out;
}

void print_row(const gpu::DeviceInfo& device, const std::string& name, const GroupTimes& t, double seconds,
               const std::string& baseline, double baseline_s, const std::string& detail, const std::string& command) {
  const double ns = 1e9 / static_cast<double>(t.rays);
  print({.bench = "cache_groups",
         .name = name,
         .device = device.name,
         .value = ns * seconds,
         .unit = "ns/ray",
         .better = Better::lower,
         .baseline = baseline,
         .baseline_value = ns * baseline_s,
         .detail = detail},
        command);
}

void run(Options& options, const std::string& command) {
  gpu::Context context(options.device);
  const gpu::DeviceInfo& device = context.info();
  if (options.rays == 0) options.rays = device.cpu ? 1u << 18 : 1u << 23;
  const SceneRays rays = scene_rays(context, options.shared, options.rays);
  for (const uint32_t division : {10u, 100u, 1000u, 200000u}) {
    CacheConfig config;
    config.kind = "concurrent";
    config.hit_point = "cached";
    config.division = division;
    GroupTimes all;
    for (const Segment& segment : rays.segments) {
      const GroupTimes t = group_times(context, rays, segment, config, options.runs);
      all.rays += t.rays;
      all.groups += t.groups;
      all.elect += t.elect;
      all.share += t.share;
      all.sort += t.sort;
      all.trace += t.trace;
    }
    const std::string name = fmt::format("{}, all depths, division {}: ", rays.name, division);
    const double saved = 1 - static_cast<double>(all.groups) / static_cast<double>(all.rays);
    const std::string detail = fmt::format("{} groups of {} rays", all.groups, all.rays);
    print_row(device, name + "election", all, all.elect, "sort of as many keys, alone", all.sort, detail, command);
    if (all.groups == all.rays) continue;  // no ray follows another one
    print_row(device, name + "election and hits handed on", all, all.elect + all.share,
              "tracing those that follow, in order", saved * all.trace, detail, command);
  }
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer::bench;
  Options options;
  CLI::App app{"Rays of a depth grouped by their key: an election against a sort, and against tracing"};
  app.add_option("--device", options.device, "part of a platform's or device's name, or an index");
  app.add_option("--shared", options.shared, "folder that holds scenes/munich");
  app.add_option("--rays", options.rays, "rays that are launched; 0: what suits the device");
  app.add_option("--runs", options.runs, "runs that medians are of")->check(CLI::Range(1, 1000));
  CLI11_PARSE(app, argc, argv);
  try {
    run(options, command_line(argc, argv));
  } catch (const std::exception& e) {
    fmt::print(stderr, "bench_cache_groups: {}\n", e.what());
    return 1;
  }
}
