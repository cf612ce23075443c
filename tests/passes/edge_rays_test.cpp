// SPDX-License-Identifier: Apache-2.0
// edge_rays: rays leave the edges of their prefixes at the angle at which the way from the image meets them, in the
// free sector, evenly over its azimuths; most do not lead away from the receivers' heights. Each ray is checked in
// double from the wedges and prefixes of the device.
#include "passes/edge_rays.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "passes/queue_words.hpp"
#include "passes/sort.hpp"
#include "passes/wedge_cases.hpp"
#include "passes/wedge_prefixes.hpp"
#include "passes/wedge_sight.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint32_t ray_roots = 5;

struct EdgeRay {
  glm::dvec3 from, along;
  uint32_t node, surface;
};

struct Launched {
  std::vector<uint32_t> keys;
  std::vector<wt_wedge_prefix> prefixes;
  std::vector<wt_wedge> wedges;
  std::vector<EdgeRay> rays;
};

// The rays of every prefix of two transmitters, in batches of this many. tested: wedge_sight has run.
Launched launch(uint32_t each, float low_m, float high_m, uint32_t batch, bool tested = false) {
  const Scene scene = box_and_panels();
  const DeviceScene uploaded = make_device_scene(context(), scene, false, 100);
  std::vector<EndState> tx;
  for (const glm::dvec3& p : {glm::dvec3{-7.1, 1.3, 2.2}, {6.3, 5.9, 7.1}}) tx.push_back({.position_m = p});
  const RadioEnds ends = make_radio_ends(context(), tx, {EndState{}}, {});
  const Wedges wedges(context(), scene, {}, {}, true);
  Sequences set(context(), 1 << 12);
  enter(set, uploaded, all_sequences(2, 9, 2), 2);
  const uint32_t nodes = set.collect(2);
  WedgePrefixes see(context());
  WedgePrefixList& list =
      see(uploaded, wedges.list(), ends, set.table(), set.quarters(), set.nodes(), nodes, set.counters());
  WedgeSight sight(context(), uploaded, scene, false, most_pieces);
  if (tested) sight(uploaded, wedges.list(), set.table(), list);
  Sort sort(context());
  sort(list.keys, list.order, list.count, wedges.key_bits());
  see.place(list);
  const uint32_t in_sight = sight.in_sight(list), all = list.count;
  CHECK((tested ? in_sight < all : in_sight == all));
  CHECK(in_sight > 0);
  Launched out{list.keys.read(0, in_sight), list.sorted.read(0, in_sight), wedges.list().wedges.read(), {}};
  EdgeRays pass(context(), each, most_pieces, ray_roots, low_m, high_m);
  const uint64_t total = pass.total(in_sight);
  CHECK(total == uint64_t{in_sight} * each);
  for (uint64_t first = 0; first < total; first += batch) {
    const auto count = static_cast<uint32_t>(std::min<uint64_t>(batch, total - first));
    RayQueue queue = make_ray_queue(context(), batch, "rays of edges");
    pass(queue, list, wedges.list(), first, count);
    CHECK(queue.count == count);
    const std::vector<float> planes = queue.planes.read();
    const auto at = [&](size_t plane, uint32_t i) { return planes[plane * queue.capacity + i]; };
    const auto vector_at = [&](size_t plane, uint32_t i) {
      return glm::dvec3(at(plane, i), at(plane + 1, i), at(plane + 2, i));
    };
    for (uint32_t i = 0; i < count; ++i)
      out.rays.push_back({vector_at(WT_RAY_ORIGIN, i), vector_at(WT_RAY_DIRECTION, i),
                          std::bit_cast<uint32_t>(at(WT_RAY_NODE, i)), std::bit_cast<uint32_t>(at(WT_RAY_SURFACE, i))});
  }
  return out;
}

// The azimuth of a direction about the wedge, from its face 0 on.
double azimuth_of(const Wedge& w, const glm::dvec3& along) {
  const double azimuth = std::atan2(glm::dot(along, w.normal), glm::dot(along, w.face));
  return azimuth < -1e-6 ? azimuth + 2 * std::numbers::pi : azimuth;
}

// The place along the edge from which a ray starts, whose origin is a few millimetres beside it.
double place_of(const Wedge& w, const EdgeRay& ray) { return glm::dot(ray.from - w.start, w.along); }

}  // namespace

TEST_CASE("rays leave every edge that is seen, at the angle of the wave that meets it") {
  constexpr uint32_t each = 40;
  const Launched found = launch(each, -1e9f, 1e9f, 1000);
  REQUIRE(found.prefixes.size() > 40);
  REQUIRE(found.rays.size() == found.prefixes.size() * each);
  for (size_t k = 0; k < found.rays.size(); ++k) {
    const wt_wedge_prefix& prefix = found.prefixes[k / each];
    const uint32_t number = found.keys[k / each] >> 5;
    const Wedge w = wedge_of(found.wedges[number]);
    const EdgeRay& ray = found.rays[k];
    CHECK(ray.node == (WT_ROOT | (ray_roots + number) | k % each % 4 << WT_QUARTER_SHIFT));
    CHECK((ray.surface == w.surface[0] || ray.surface == w.surface[1]));
    CHECK(std::abs(glm::length(ray.along) - 1) < 1e-6);
    const double x = place_of(w, ray);
    CHECK(x > -0.01);
    CHECK(x < w.length_m + 0.01);
    CHECK(glm::distance(ray.from, w.start + x * w.along) < 0.01);
    const glm::dvec3 image(prefix.image[0], prefix.image[1], prefix.image[2]);
    const glm::dvec3 way = w.start + x * w.along - image;
    CHECK(std::abs(glm::dot(ray.along, w.along) - glm::dot(way, w.along) / glm::length(way)) < 0.01);
    CHECK(in_sector(w, w.start + ray.along, -1e-5));
    // Azimuths follow each other evenly.
    const double share = (static_cast<double>(k % each) + 0.5) / each;
    CHECK(std::abs(azimuth_of(w, ray.along) - share * w.exterior_rad) < 1e-4);
  }
}

TEST_CASE("places are spread over the edge: no gap is much wider than that of even ones") {
  constexpr uint32_t each = 64;
  const Launched found = launch(each, -1e9f, 1e9f, 4096);
  for (size_t i = 0; i < found.prefixes.size(); ++i) {
    const Wedge w = wedge_of(found.wedges[found.keys[i] >> 5]);
    std::vector<double> places{0, w.length_m};
    for (size_t n = 0; n < each; ++n) places.push_back(place_of(w, found.rays[i * each + n]));
    std::ranges::sort(places);
    double widest = 0;
    for (size_t n = 1; n < places.size(); ++n) widest = std::max(widest, places[n] - places[n - 1]);
    CHECK(widest < 2.7 * w.length_m / each + 0.01);  // golden steps: three gaps, the widest 2.62 of an even one
  }
}

TEST_CASE("rays leave the pieces of edges that wedge_sight has left, and are spread over them") {
  constexpr uint32_t each = 256;
  const Launched found = launch(each, -1e9f, 1e9f, 4096, true);
  size_t cut = 0;
  for (size_t i = 0; i < found.prefixes.size(); ++i) {
    const Wedge w = wedge_of(found.wedges[found.keys[i] >> 5]);
    const uint32_t pieces = found.prefixes[i].pieces;
    cut += pieces != 0xFFFFFFFF;
    std::vector<uint32_t> begun(most_pieces, 0);
    for (size_t n = 0; n < each; ++n) {
      const double at = place_of(w, found.rays[i * each + n]) / w.length_m * most_pieces;
      const auto piece = static_cast<uint32_t>(std::clamp(at, 0.0, most_pieces - 1.0));
      // Rays begin a few millimetres beside their places.
      const bool near = std::abs(at - std::round(at)) * w.length_m / most_pieces < 0.01;
      CHECK((near || (pieces >> piece & 1) != 0));
      ++begun[piece];
    }
    const auto even = static_cast<uint32_t>(each / std::popcount(pieces));
    for (uint32_t piece = 0; piece < most_pieces; ++piece)
      if (pieces >> piece & 1) CHECK(begun[piece] + 3 >= even / 2);
  }
  CHECK(cut > 5);
}

TEST_CASE("above all receivers rays do not rise, below them they do not fall; one of nine goes anywhere") {
  constexpr uint32_t each = 90;
  struct Heights {
    float low_m, high_m;
  };
  for (const Heights heights : {Heights{-20, -10}, Heights{30, 40}}) {
    CAPTURE(heights.low_m);
    const Launched found = launch(each, heights.low_m, heights.high_m, 777);
    const double away = heights.high_m < 0 ? 1 : -1;  // receivers are below, or above
    size_t limited = 0, rising = 0;
    for (size_t i = 0; i < found.prefixes.size(); ++i) {
      const Wedge w = wedge_of(found.wedges[found.keys[i] >> 5]);
      // Rays of one place: the lowest that its cone reaches says whether any ray of it can go towards the receivers.
      for (size_t n = 0; n < each; ++n) {
        const EdgeRay& ray = found.rays[i * each + n];
        const double t = glm::dot(ray.along, w.along), s = std::sqrt(std::max(1 - t * t, 0.0));
        double nearest = 1;
        for (int step = 0; step <= 1000; ++step) {
          const double azimuth = 0.001 * step * w.exterior_rad;
          nearest = std::min(
              nearest, away * (t * w.along.z + s * (std::cos(azimuth) * w.face.z + std::sin(azimuth) * w.normal.z)));
        }
        CHECK(in_sector(w, w.start + ray.along, -1e-5));
        const double leads_away = away * ray.along.z;
        if (n % 9 == 0) {
          rising += leads_away > 0.01;
        } else if (nearest < -0.05) {  // surely some
          ++limited;
          CHECK(leads_away < 1e-5);
        }
      }
    }
    CHECK(limited > found.rays.size() / 2);
    CHECK(rising > 20);
  }
}

TEST_CASE("batches change no ray") {
  // Prefixes are listed in no particular order.
  const auto rays_of = [](uint32_t batch) {
    std::vector<std::array<double, 8>> out;
    for (const EdgeRay& ray : launch(33, 0, 1, batch).rays)
      out.push_back({ray.from.x, ray.from.y, ray.from.z, ray.along.x, ray.along.y, ray.along.z,
                     static_cast<double>(ray.node), static_cast<double>(ray.surface)});
    std::ranges::sort(out);
    return out;
  };
  const auto whole = rays_of(1 << 20);
  CHECK(whole.size() > 1000);
  CHECK(rays_of(100) == whole);
}
