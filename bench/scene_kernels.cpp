// SPDX-License-Identifier: Apache-2.0
// Hits of all shapes are compared with each other, and those of moving instances with a trace of everything.
#include "scene_kernels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <optional>
#include <random>

#include "accel/layout.hpp"
#include "accel/triangles.hpp"
#include "kernel_costs.hpp"
#include "passes/bounces.hpp"
#include "passes/generate_rays.hpp"
#include "passes/sequences.hpp"
#include "passes/trace.hpp"
#include "passes/trace_moving.hpp"
#include "places.hpp"
#include "scene/load.hpp"
#include "scene/vehicle_model.hpp"
#include "simulation/placement.hpp"

namespace wavetracer::bench {
namespace {

constexpr uint32_t packet = 16, interactions = 3;
constexpr uint64_t least_slots = 1 << 18;
constexpr double trace_bytes = 6.0 * sizeof(float) + WT_HIT_PLANES * sizeof(float);

constexpr std::array shape_kernels{"trace_bvh2/trace", "trace_bvh8/trace", "trace_packet16/trace"};
constexpr std::array moving_kernels{"trace_moving/trace_moving", "top_level/instance_keys", "top_level/leaves",
                                    "top_level/inner_boxes", "top_level/top_nodes"};
constexpr std::array sequence_kernels{"bounces/bounces", "sequences/clear", "sequences/regrow", "sequences/follow"};

bool any(const KernelRows& rows, std::span<const char* const> kernels) {
  return std::ranges::any_of(kernels, [&](const char* kernel) { return rows.wants(kernel); });
}

HitList hits_of_packets(gpu::Context& context, const RayQueue& rays) {
  HitList hits = make_hit_list(context, rays.count);
  hits.block = packet;
  hits.block_hits = context.buffer<uint32_t>(rays.capacity / packet + 1, "block counts");
  return hits;
}

size_t differing_hits(const HitList& a, const HitList& b, uint32_t count) {
  size_t differing = 0;
  for (const uint32_t plane : {WT_HIT_T, WT_HIT_PRIMITIVE}) {
    const auto x = a.planes.read(size_t{plane} * a.capacity, count),
               y = b.planes.read(size_t{plane} * b.capacity, count);
    for (size_t i = 0; i < count; i++) differing += std::bit_cast<uint32_t>(x[i]) != std::bit_cast<uint32_t>(y[i]);
  }
  return differing;
}

// Adds the trees that only CPUs have.
void add_trees_of_cpus(gpu::Context& context, const Scene& scene, DeviceScene& out) {
  if (out.cpu) return;
  const std::vector<AccelTriangle> triangles = accel_triangles(scene);
  BuildOptions options = BuildOptions::for_bvh2();
  options.spatial_splits = false;
  out.packet_nodes2 = context.buffer(make_bvh2(build_binary(triangles, options), triangles).nodes, "BVH2 packet nodes");
  options = BuildOptions::for_bvh8();
  options.spatial_splits = false;
  const Bvh8 eight = make_bvh8(build_binary(triangles, options), triangles);
  out.nodes8 = context.buffer(eight.nodes, "BVH8 nodes");
  out.blocks8 = context.buffer(eight.blocks, "BVH8 blocks");
  out.require_stack("WT_BVH8_STACK", 7 * eight.max_depth + 1);
}

class SceneKernels {
 public:
  SceneKernels(KernelRows& rows, gpu::Context& context, const Config& config, uint32_t ray_count, uint32_t vehicles)
      : rows_(rows),
        context_(context),
        scene_(load_scene(config)),
        still_(make_device_scene(context, scene_, false)),
        rays_(make_ray_queue(context, ray_count, "rays")),
        vehicles_(vehicles) {
    const auto& at = config.transmitters.front().position_m;
    const glm::dvec3 position_m = glm::dvec3(at[0], at[1], at[2]) - scene_.origin_m;
    GenerateRays(context, LaunchDirections("hilbert", ray_count, 1))(rays_, {0, position_m}, 0, ray_count);
  }

  void run() {
    if (any(rows_, shape_kernels)) shapes();
    if (any(rows_, moving_kernels)) moving();
    if (any(rows_, sequence_kernels)) whole_ways();
  }

 private:
  KernelRows& rows_;
  gpu::Context& context_;
  Scene scene_;
  DeviceScene still_;
  RayQueue rays_;
  uint32_t vehicles_;

  KernelShare share(double operations) const {
    return {"segments", static_cast<double>(rays_.count), {.bytes = trace_bytes, .operations = operations}};
  }

  void shapes() {
    const double operations = tree_operations(scene_.triangles.size());
    const std::string variant = fmt::format("{} rays of a launch", rays_.count);
    HitList hits = make_hit_list(context_, rays_.count);
    Trace bvh2(context_, still_, TraceShape::bvh2);
    bvh2(still_, rays_, hits);
    rows_.measure(context_, {.variant = variant,
                             .kernels = {{"trace_bvh2/trace", share(operations)}},
                             .run = [&] { bvh2(still_, rays_, hits); },
                             .wrong = [] { return 0; }});
    if (!rows_.wants("trace_bvh8/trace") && !rows_.wants("trace_packet16/trace")) return;
    add_trees_of_cpus(context_, scene_, still_);
    HitList others = hits_of_packets(context_, rays_);
    for (const auto& [kernel, shape] :
         {std::pair{"trace_bvh8/trace", TraceShape::bvh8}, {"trace_packet16/trace", TraceShape::packet16}}) {
      Trace trace(context_, still_, shape);
      rows_.measure(context_, {.variant = variant,
                               .kernels = {{kernel, share(operations)}},
                               .run = [&] { trace(still_, rays_, others); },
                               .wrong = [&] { return differing_hits(hits, others, rays_.count); }});
    }
  }

  std::vector<Placement> placements() const {
    std::mt19937 generator(1);
    const auto draw = [&](double most) { return most * (static_cast<double>(generator()) * 0x1p-31 - 1); };
    std::vector<Placement> out(vehicles_);
    for (Placement& p : out) {
      p.position_m = {draw(still_.extent_m / 2), draw(still_.extent_m / 2), scene_.lower.z};
      p.rotation = glm::mat3_cast(glm::angleAxis(draw(std::numbers::pi), glm::dvec3(0, 0, 1)));
    }
    return out;
  }

  // The tree over vehicles is built on the device, and the rays of the launch are traced against it.
  void moving() {
    const std::vector<Scene> models{vehicle_model("car", 5, 1.8, 1.5)};
    std::vector<Instance> instances(vehicles_);
    for (uint32_t i = 0; i < vehicles_; i++) {
      const auto first = scene_.surfaces.size() + i * models[0].surfaces.size();
      instances[i] = {fmt::format("car{}", i), "passenger", 0, static_cast<uint32_t>(first)};
    }
    auto [scene, place] =
        with_instances(context_, make_device_scene(context_, scene_, false), scene_, models, instances);
    InstancePlacement placement(context_, std::move(place), instances.size(), TopLevelBuild::device);
    const std::vector<Placement> places = placements();
    const std::string variant = fmt::format("{} vehicles", vehicles_);
    const double n = vehicles_;
    // Its tree is checked by the hits below.
    rows_.measure(context_, {.variant = variant,
                             .kernels = {{"top_level/instance_keys", {"vehicles", n, {.bytes = 200, .operations = 60}}},
                                         {"top_level/leaves", {"vehicles", n, {.bytes = 200}}},
                                         {"top_level/inner_boxes", {"vehicles", n, {.bytes = 96}}},
                                         {"top_level/top_nodes", {"vehicles", n, {.bytes = 128}}}},
                             .run = [&] { placement.place(scene, places); },
                             .wrong = [] { return 0; }});
    if (!rows_.wants("trace_moving/trace_moving")) return;
    placement.place(scene, places);
    HitList all = make_hit_list(context_, rays_.count), hits = make_hit_list(context_, rays_.count);
    const TraceShape shape = context_.info().cpu ? TraceShape::bvh8 : TraceShape::bvh2;
    Trace(context_, scene, shape)(scene, rays_, all);
    Trace fixed(context_, scene, shape, {}, Trace::Scope::fixed);
    TraceMoving trace_moving(context_, scene);
    rows_.measure(context_, {.variant = variant,
                             .kernels = {{"trace_moving/trace_moving", share(instance_tree_operations(vehicles_))}},
                             .run = [&] { trace_moving(scene, rays_, hits); },
                             .wrong = [&] { return differing_hits(all, hits, rays_.count); },
                             .prepare = [&] { fixed(scene, rays_, hits); }});
  }

  // All segments of rays in one launch, which only GPUs do in frames; then the set of their sequences grows.
  void whole_ways() {
    Bounces bounces(context_, still_, false, false);
    const auto enter = [&](Sequences& into) { bounces(still_, rays_, interactions, into.trie(), nullptr); };
    uint64_t slots = least_slots;
    std::optional<Sequences> set;
    for (bool enough = false; !enough; slots *= 4) {
      set.emplace(context_, slots);
      enter(*set);
      enough = !set->overflowed();
    }
    slots = set->table().size();
    const wt_counters counters = set->counters().read(Stage::trace);
    double segments = 0, alive = rays_.count, hits = 0;
    for (uint32_t k = 0; k < interactions; k++) {
      segments += alive;
      alive -= counters.ended[k];
      hits += alive;
    }
    // A ray is read once, and each of its hits is added to a sequence.
    const double bytes = (rays_.count * 8.0 + hits * 3.0) * sizeof(uint32_t) / segments;
    const std::string variant = fmt::format("{} rays, {} interactions", rays_.count, interactions);
    rows_.measure(context_, {.variant = variant,
                             .kernels = {{"bounces/bounces",
                                          {"segments",
                                           segments,
                                           {.bytes = bytes, .operations = tree_operations(scene_.triangles.size())}}}},
                             .run = [&] { enter(*set); },
                             .wrong = [] { return 0; },
                             .prepare = [&] { set->clear(); }});
    grow(enter, slots);
  }

  void grow(const std::function<void(Sequences&)>& enter, uint64_t slots) {
    std::optional<Sequences> set;
    uint32_t listed = 0;
    const auto prepare = [&] {
      set.emplace(context_, slots);
      enter(*set);
      listed = set->collect(1);
    };
    prepare();
    const double moved = static_cast<double>(slots) * interactions;
    rows_.measure(context_,
                  {.variant = fmt::format("a set of {} sequences grows", listed),
                   .kernels = {{"sequences/clear", {"slots", 4.0 * static_cast<double>(slots), {.bytes = 12}}},
                               {"sequences/regrow", {"slots", moved, {.bytes = 8}}},
                               {"sequences/follow", {"sequences", double{1} * listed, {.bytes = 8, .gathers = 1}}}},
                   .run = [&] { set->regrow(interactions, listed); },
                   .wrong = [] { return 0; },
                   .prepare = prepare});
  }
};

}  // namespace

void measure_scene_kernels(KernelRows& rows, gpu::Context& context, const std::string& shared, uint32_t ray_count,
                           uint32_t vehicles) {
  if (!any(rows, shape_kernels) && !any(rows, moving_kernels) && !any(rows, sequence_kernels)) return;
  const std::optional<Place> munich = munich_place(shared, 1, 1);
  const Config config = config_of(munich ? *munich : city_place(1, 1), 1, 1);
  SceneKernels(rows, context, config, ray_count, vehicles).run();
}

}  // namespace wavetracer::bench
