// SPDX-License-Identifier: Apache-2.0
// Points and rays are random; triangles are a hilly ground of 80,000.
#include "suite_kernels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "kernel_costs.hpp"
#include "passes/curves.hpp"
#include "passes/pack_rays.hpp"
#include "passes/trace.hpp"
#include "passes/trace_rays.hpp"

namespace wavetracer::bench {
namespace {

constexpr uint32_t most_compared = 1u << 18;
constexpr int ground_side = 200;

std::vector<AccelTriangle> hilly_ground() {
  const auto corner = [](float(&v)[3], int x, int y) {
    v[0] = static_cast<float>(x);
    v[1] = static_cast<float>(y);
    v[2] = 2 * std::sin(0.7f * v[0]) * std::cos(0.5f * v[1]);
  };
  std::vector<AccelTriangle> triangles;
  for (int x = 0; x < ground_side; ++x)
    for (int y = 0; y < ground_side; ++y)
      for (const int half : {0, 1}) {
        AccelTriangle t{};
        corner(t.v[0], x + half, y + half);
        corner(t.v[1], x + 1, y);
        corner(t.v[2], x, y + 1);
        t.primitive = t.surface = static_cast<uint32_t>(triangles.size());
        triangles.push_back(t);
      }
  return triangles;
}

class SuiteKernels {
 public:
  SuiteKernels(KernelRows& rows, gpu::Context& context, uint32_t n, uint32_t traced)
      : rows_(rows), context_(context), n_(n), traced_(traced) {}

  void run() {
    if (rows_.wants("curves/point_keys"))
      for (const char* name : {"morton2", "morton3", "morton5", "hilbert2", "hilbert3"}) {
        keys<uint32_t>(name);
        keys<uint64_t>(name);
      }
    if (std::ranges::any_of(std::to_array({"rays_to_planes", "planes_to_rays", "hits_to_planes", "planes_to_hits"}),
                            [&](const char* kernel) { return rows_.wants(fmt::format("pack_rays/{}", kernel)); }))
      pack();
    if (rows_.wants("trace_rays/nearest_hits") || rows_.wants("trace_rays/any_hits")) trace();
  }

 private:
  KernelRows& rows_;
  gpu::Context& context_;
  uint32_t n_, traced_;

  template <class Key>
  void keys(const std::string& name) {
    constexpr uint32_t key_bits = 8 * sizeof(Key);
    const uint32_t dimensions = curve_dimensions(name);
    const uint32_t level = std::min(most_curve_bits(name, key_bits), 20u);
    std::mt19937 random(1);
    std::vector<float> points(size_t{n_} * dimensions);
    for (float& x : points) x = static_cast<float>(random() >> 8) * 0x1p-24f;
    const auto from = context_.buffer(points, "points");
    auto out = context_.buffer<Key>(n_, "keys");
    const std::vector<float> lower(dimensions, 0.0f), upper(dimensions, 1.0f);
    PointKeys pass(context_, name, key_bits);
    const CurveBox box{lower, upper, uint64_t{1} << level};
    const auto wrong = [&] {
      const std::vector<Key> found = out.read(0, std::min(n_, most_compared));
      size_t count = 0;
      for (size_t i = 0; i < found.size(); ++i) count += found[i] != host_key(name, &points[i * dimensions], level);
      return count;
    };
    rows_.measure(context_,
                  {.variant = fmt::format("{}, {} bits, n = {}", name, key_bits, n_),
                   .kernels = {{"curves/point_keys",
                                {"points", static_cast<double>(n_), {.bytes = 4.0 * dimensions + sizeof(Key)}}}},
                   .run = [&] { pass(from, dimensions, n_, box, out); },
                   .wrong = wrong});
  }

  static uint64_t host_key(const std::string& name, const float* point, uint32_t level) {
    using namespace device;
    const auto cell = [&](size_t d) {
      const float cells = std::ldexp(1.0f, static_cast<int>(level));
      return wt_box_cell(point[d], 0, cells, cells, (1u << level) - 1);
    };
    if (name == "morton2") return wt_morton2_encode(cell(0), cell(1));
    if (name == "morton3") return wt_morton3_encode(cell(0), cell(1), cell(2));
    if (name == "morton5") return wt_morton5_encode(cell(0), cell(1), cell(2), cell(3), cell(4));
    if (name == "hilbert2") return wt_hilbert2_encode(cell(0), cell(1), level);
    return wt_hilbert3_encode(cell(0), cell(1), cell(2), level);
  }

  std::vector<wt_packed_ray> random_rays(uint32_t count) const {
    std::mt19937 random(1);
    const auto number = [&](float low, float high) {
      return low + (high - low) * static_cast<float>(random() >> 8) * 0x1p-24f;
    };
    std::vector<wt_packed_ray> rays(count);
    for (wt_packed_ray& ray : rays)
      ray = {{number(0, ground_side), number(0, ground_side), 5},
             0,
             {number(-1, 1), number(-1, 1), number(-0.5f, 0.1f)},
             std::numeric_limits<float>::infinity()};
    return rays;
  }

  void pack() {
    const auto packed = context_.buffer(random_rays(n_), "rays");
    auto again = context_.buffer<wt_packed_ray>(n_, "rays again");
    auto hits = context_.buffer<wt_packed_hit>(n_, "hits"),
         hits_again = context_.buffer<wt_packed_hit>(n_, "hits again");
    hits.write(std::vector<wt_packed_hit>(n_, {1, 2, 0, 0}));
    RayQueue queue = make_ray_queue(context_, n_, "queue", WT_RAY_LABELLED_PLANES);
    HitList list = make_hit_list(context_, n_);
    PackRays pass(context_);
    const auto share = [&](const char* element, double bytes) {
      return KernelShare{element, static_cast<double>(n_), {.bytes = bytes}};
    };
    rows_.measure(context_, {.variant = fmt::format("n = {}", n_),
                             .kernels = {{"pack_rays/rays_to_planes", share("rays", 32 + 4 * WT_RAY_LABELLED_PLANES)},
                                         {"pack_rays/planes_to_rays", share("rays", 24 + 32)},
                                         {"pack_rays/hits_to_planes", share("hits", 12 + 4 * WT_HIT_PLANES)},
                                         {"pack_rays/planes_to_hits", share("hits", 8 + 16)}},
                             .run =
                                 [&] {
                                   pass(packed, n_, queue);
                                   pass.unpack(queue, again);
                                   pass(hits, n_, list);
                                   pass.unpack(list, n_, hits_again);
                                 },
                             .wrong =
                                 [&] {
                                   size_t wrong = 0;
                                   const uint32_t count = std::min(n_, most_compared);
                                   const auto a = packed.read(0, count), b = again.read(0, count);
                                   const auto c = hits_again.read(0, count);
                                   for (size_t i = 0; i < count; ++i)
                                     wrong += a[i].origin[0] != b[i].origin[0] ||
                                              a[i].direction[2] != b[i].direction[2] || c[i].primitive != 2;
                                   return wrong;
                                 }});
  }

  void trace() {
    const std::vector<AccelTriangle> triangles = hilly_ground();
    const DeviceTrees trees = make_device_trees(context_, triangles, false, ground_side);
    std::vector<float> corners;
    for (const AccelTriangle& t : triangles)
      for (const auto& corner : t.v) corners.insert(corners.end(), corner, corner + 3);
    const auto corner_buffer = context_.buffer(corners, "corners");
    const auto rays = context_.buffer(random_rays(traced_), "rays");
    auto hits = context_.buffer<wt_packed_hit>(traced_, "hits");
    auto met = context_.buffer<uint32_t>(traced_, "met");
    TraceRays pass(context_, trees);
    const auto wrong = [&] {
      RayQueue queue = make_ray_queue(context_, traced_, "queue");
      HitList list = make_hit_list(context_, traced_);
      auto expected = context_.buffer<wt_packed_hit>(traced_, "expected hits");
      PackRays pack(context_);
      pack(rays, traced_, queue);
      Trace(context_, trees, TraceShape::bvh2)(trees, queue, list);
      pack.unpack(list, traced_, expected);
      const auto a = hits.read(), b = expected.read();
      const auto any = met.read();
      size_t count = 0;
      for (size_t i = 0; i < a.size(); ++i)
        count += a[i].primitive != b[i].primitive || a[i].t != b[i].t || any[i] != (a[i].primitive != WT_NONE ? 1 : 0);
      return count;
    };
    const auto share = [&](double bytes, double operations) {
      return KernelShare{"rays", static_cast<double>(traced_), {.bytes = bytes, .operations = operations}};
    };
    rows_.measure(context_, {.variant = fmt::format("{} random rays, {} triangles", traced_, triangles.size()),
                             .kernels = {{"trace_rays/nearest_hits", share(48, tree_operations(triangles.size()))},
                                         {"trace_rays/any_hits", share(36, tree_operations(triangles.size()))}},
                             .run =
                                 [&] {
                                   pass.nearest(trees, corner_buffer, rays, traced_, hits);
                                   pass.any(trees, rays, traced_, met);
                                 },
                             .wrong = wrong});
  }
};

}  // namespace

void measure_suite_kernels(KernelRows& rows, gpu::Context& context, uint32_t n, uint32_t traced) {
  SuiteKernels(rows, context, n, traced).run();
}

}  // namespace wavetracer::bench
