// SPDX-License-Identifier: Apache-2.0
// bench_leaks aims rays at the edges and vertices of closed rooms from inside, through the trace pass. Each must hit: a
// ray that leaves a closed surface without a hit passed between two triangles that share an edge or a vertex. The value
// is the number of leaks, which must be 0; speed does not matter.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <random>
#include <span>
#include <thread>

#include "gpu/gpu.hpp"
#include "json_line.hpp"
#include "passes/device_scene.hpp"
#include "passes/ray_queue.hpp"
#include "passes/scan.hpp"
#include "passes/trace.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

using glm::dvec3;
using Float3 = std::array<float, 3>;

constexpr int cells = 16;  // cells per side of a face
constexpr size_t triangles_per_axis = 4 * cells * cells, triangle_count = 3 * triangles_per_axis;  // 3,072
const dvec3 half_m(80, 60, 40);

struct Room {
  std::string name;
  dvec3 centre_m;
  double jitter;  // distance of vertices from their plane and their place in it, as a share of a cell
};

// The float32 spacing at UTM coordinates (Munich: zone 32, easting 691 km, northing 5,335 km) is half a metre, so the
// last room is not flat. The program itself recentres scenes; this benchmark does not.
const Room rooms[] = {{"flat, at the origin", {0, 0, 0}, 0},
                      {"jittered, at the origin", {0, 0, 0}, 0.3},
                      {"jittered, 7 km off", {7000, -7000, 100}, 0.3},
                      {"jittered, at UTM coordinates", {691000, 5335000, 520}, 0.3}};

enum class Aim { edges, vertices };

// Returns a box whose faces are grids. Vertices on its edges and corners are one vertex each, so it is closed; jittered
// vertices move so little that its inner half stays inside.
Scene make_room(const Room& room) {
  Scene scene;
  std::mt19937 generator(1);
  std::map<std::array<int, 3>, uint32_t> known;
  const auto offset = [&](int axis) {
    const double unit = static_cast<double>(generator()) * 0x1p-31 - 1;
    return room.jitter * unit * 2 * half_m[axis] / cells;
  };
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, inserted] = known.try_emplace(at, static_cast<uint32_t>(scene.vertices.size()));
    if (inserted) {
      dvec3 p;
      for (int axis = 0; axis < 3; axis++)
        p[axis] = static_cast<float>(room.centre_m[axis] + half_m[axis] * (2.0 * at[axis] / cells - 1) + offset(axis));
      scene.vertices.push_back(p);
    }
    return place->second;
  };
  for (int face = 0; face < 6; face++) {
    const int axis = face / 2, next = (axis + 1) % 3, last = (axis + 2) % 3;
    for (int i = 0; i < cells; i++)
      for (int j = 0; j < cells; j++) {
        std::array<uint32_t, 4> corner;
        for (int k = 0; k < 4; k++) {
          std::array<int, 3> at;
          at[axis] = face % 2 * cells;
          at[next] = i + (k == 1 || k == 2);
          at[last] = j + (k >= 2);
          corner[k] = vertex(at);
        }
        scene.triangles.push_back({corner[0], corner[1], corner[2]});
        scene.triangles.push_back({corner[0], corner[2], corner[3]});
      }
  }
  // All triangles form one surface: rays here start on no surface, so it is never left out.
  scene.triangle_surface.assign(scene.triangles.size(), 0);
  scene.triangle_object.assign(scene.triangles.size(), 0);
  scene.surfaces.resize(1);
  scene.surfaces[0].triangle_count = static_cast<uint32_t>(scene.triangles.size());
  for (uint32_t i = 0; i < scene.triangles.size(); i++) scene.surface_triangles.push_back(i);
  scene.lower = scene.upper = scene.vertices[0];
  for (const dvec3& p : scene.vertices) {
    scene.lower = glm::min(scene.lower, p);
    scene.upper = glm::max(scene.upper, p);
  }
  scene.surfaces[0].lower = scene.lower;
  scene.surfaces[0].upper = scene.upper;
  return scene;
}

// Returns a point of a triangle's edge, or a vertex of it, in the arithmetic of rays.
Float3 choose_target(const Scene& scene, size_t triangle, size_t corner, float along) {
  const auto& corners = scene.triangles[triangle];
  const dvec3 &a = scene.vertices[corners[corner]], &b = scene.vertices[corners[(corner + 1) % 3]];
  Float3 target;
  for (int axis = 0; axis < 3; axis++) {
    const float start = static_cast<float>(a[axis]);
    target[axis] = start + along * (static_cast<float>(b[axis]) - start);
  }
  return target;
}

// Aims sixteen rays at neighbouring triangles, which a packet of 16 traces together. Even groups start from one point
// and pass edges and vertices as closely as rounding allows; odd ones run along an axis, where nothing is rounded, and
// hit them exactly. It is a pure function of `group`.
void aim_group(const Scene& scene, const Room& room, Aim aim, uint64_t group, uint32_t capacity, uint32_t first,
               std::span<float> planes) {
  std::seed_seq seed{static_cast<uint32_t>(group), static_cast<uint32_t>(group >> 32)};
  std::minstd_rand generator(seed);
  const auto unit = [&] { return static_cast<float>(generator()) * 0x1p-31f; };
  Float3 middle;
  for (int axis = 0; axis < 3; axis++)
    middle[axis] = static_cast<float>(room.centre_m[axis] + half_m[axis] * (unit() - 0.5));
  const size_t base = generator() % scene.triangles.size();
  for (uint32_t lane = 0; lane < 16; lane++) {
    const size_t triangle = (base + generator() % 16) % scene.triangles.size(), corner = generator() % 3;
    const Float3 target = choose_target(scene, triangle, corner, aim == Aim::edges ? unit() : 0);
    Float3 origin = middle;
    if (group % 2 == 1) {
      const size_t face_axis = triangle / triangles_per_axis;
      Float3 opposite = target;
      opposite[face_axis] = middle[face_axis];
      bool inside = true;  // inside a room whose walls are uneven
      for (int axis = 0; axis < 3; axis++)
        inside &= std::abs(opposite[axis] - room.centre_m[axis]) <= 0.8 * half_m[axis];
      if (inside) origin = opposite;
    }
    Float3 direction;
    float square = 0;
    for (int axis = 0; axis < 3; axis++) {
      direction[axis] = target[axis] - origin[axis];
      square += direction[axis] * direction[axis];
    }
    const auto plane = [&](uint32_t index) -> float& { return planes[size_t{index} * capacity + first + lane]; };
    for (uint32_t axis = 0; axis < 3; axis++) {
      plane(WT_RAY_ORIGIN + axis) = origin[axis];
      plane(WT_RAY_DIRECTION + axis) = direction[axis] / std::sqrt(square);
    }
    plane(WT_RAY_SURFACE) = std::bit_cast<float>(WT_NONE);
  }
}

// Fills a queue's planes with rays of the groups from first_group on, on all cores.
void aim_batch(const Scene& scene, const Room& room, Aim aim, uint64_t first_group, uint32_t count, uint32_t capacity,
               std::vector<float>& planes) {
  const uint32_t groups = count / 16, workers = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::jthread> threads;
  for (uint32_t w = 0; w < workers; w++)
    threads.emplace_back([&, w] {
      for (uint32_t g = w; g < groups; g += workers)
        aim_group(scene, room, aim, first_group + g, capacity, 16 * g, planes);
    });
}

struct Options {
  uint64_t rays = 100'000'000;
  std::string device;
};

uint64_t count_leaks(gpu::Context& context, const Room& room, TraceShape shape, Aim aim, uint64_t rays) {
  const Scene scene = make_room(room);
  const DeviceScene device_scene = make_device_scene(context, scene, false);
  Trace trace(context, device_scene, shape);
  Scan scan(context);
  const auto batch = static_cast<uint32_t>(std::min<uint64_t>(rays, 1 << 20));
  RayQueue queue = make_ray_queue(context, batch, "rays");
  HitList hits = make_hit_list(context, batch);
  std::vector<float> planes(size_t{WT_RAY_PLANES} * queue.capacity);
  uint64_t leaks = 0;
  for (uint64_t done = 0; done < rays; done += queue.count) {
    queue.count = static_cast<uint32_t>(std::min<uint64_t>(batch, rays - done));
    aim_batch(scene, room, aim, done / 16, queue.count, queue.capacity, planes);
    queue.planes.write(planes);
    trace(device_scene, queue, hits);
    leaks += queue.count - scan(hits.block_hits, hits.blocks(queue.count));
  }
  return leaks;
}

const char* name(TraceShape shape) {
  return shape == TraceShape::bvh2 ? "bvh2" : shape == TraceShape::bvh8 ? "bvh8" : "packet16";
}

uint64_t run(const Options& options, const std::string& command) {
  gpu::Context context(options.device);
  std::vector<TraceShape> shapes{TraceShape::bvh2};
  if (context.info().cpu) shapes = {TraceShape::bvh8, TraceShape::packet16};
  const uint64_t each = std::max<uint64_t>(options.rays / (2 * std::size(rooms)) / 16, 1) * 16;
  uint64_t all = 0;
  for (const TraceShape shape : shapes)
    for (const Room& room : rooms)
      for (const Aim aim : {Aim::edges, Aim::vertices}) {
        const uint64_t leaks = count_leaks(context, room, shape, aim, each);
        all += leaks;
        Result result{"leaks",
                      fmt::format("{}, {} triangles, aimed at {}: {}", room.name, triangle_count,
                                  aim == Aim::edges ? "edges" : "vertices", name(shape)),
                      context.info().name,
                      static_cast<double>(leaks),
                      "leaks",
                      Better::lower,
                      "",
                      {},
                      static_cast<double>(leaks) / static_cast<double>(each),
                      fmt::format("{:.3g} rays", static_cast<double>(each))};
        result.extra["rays"] = each;
        print(result, command);
      }
  return all;
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Rays aimed at edges and vertices of closed rooms: how many get out");
  bench::Options options;
  app.add_option("--rays", options.rays, "rays of each traversal shape, spread over rooms and targets");
  app.add_option("--device", options.device, "as for wavetracer run");
  CLI11_PARSE(app, argc, argv);
  try {
    if (const uint64_t leaks = bench::run(options, bench::command_line(argc, argv)); leaks > 0)
      throw RuntimeError(fmt::format("{} rays got out of a closed room: the traversal is not watertight here", leaks));
  } catch (const Error& error) {
    fmt::print(stderr, "bench_leaks: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
