// SPDX-License-Identifier: Apache-2.0
// The public OrderKeys against cells and bit loops of the host, and GenerateRays by what its launches promise.
#include "wavetracer/kernels/order_keys.hpp"

#include <doctest/doctest.h>

#include <cstring>

#include "contains.hpp"
#include "gpu/temporary.hpp"
#include "kernel_suite/soup.hpp"
#include "kernel_suite/user.hpp"
#include "wavetracer/kernels/generate_rays.hpp"

using namespace wavetracer::test;
namespace kernels = wavetracer::kernels;
using kernels::RayOrder;

namespace {

// The cell of a component in [-1, 1] among `bins`.
uint32_t bin_of(float x, uint32_t bins) {
  return std::min(bins - 1, static_cast<uint32_t>(std::floor((double{x} + 1) / 2 * bins)));
}

uint32_t interleaved(const float* direction, uint32_t bins) {
  uint32_t key = 0;
  for (uint32_t bit = 0; bit < 10; ++bit)
    for (uint32_t d = 0; d < 3; ++d) key |= (bin_of(direction[d], bins) >> bit & 1) << (3 * bit + d);
  return key;
}

std::vector<uint32_t> keys_by(const kernels::Context& context, RayOrder order, const kernels::OrderOptions& options,
                              const std::vector<kernels::Ray>& rays) {
  kernels::OrderKeys keys_of(context, order, options);
  const size_t n = rays.size(), capacity = (n + 15) / 16 * 16;
  const auto records = context.buffer<kernels::Ray>(n);
  const auto planes = context.buffer<float>(6 * capacity);
  const auto a = context.buffer<uint32_t>(n + 1), b = context.buffer<uint32_t>(n + 1);
  records.write(rays);
  std::vector<float> words(6 * capacity);
  for (size_t i = 0; i < n; ++i)
    for (size_t axis = 0; axis < 3; ++axis) {
      words[axis * capacity + i] = rays[i].origin[axis];
      words[(3 + axis) * capacity + i] = rays[i].direction[axis];
    }
  planes.write(words);
  for (const auto& keys : {a, b}) keys.write(std::vector<uint32_t>(n + 1, 7));
  keys_of(records, n, a);
  keys_of(planes, capacity, n, b);
  std::vector<uint32_t> out = a.read();
  CHECK(out == b.read());  // records and planes are the same rays
  CHECK(out.back() == 7);
  out.pop_back();
  for (const uint32_t key : out) REQUIRE(uint64_t{key} < uint64_t{1} << keys_of.bits());
  return out;
}

std::vector<kernels::Ray> launched(const kernels::Context& context, kernels::GenerateRays& launch, uint64_t first,
                                   size_t n) {
  const auto rays = context.buffer<kernels::Ray>(n + 1);
  rays.write(std::vector<kernels::Ray>(n + 1, {{7, 7, 7}, 7, {7, 7, 7}, 7}));
  launch({1, 2, 3}, first, n, rays);
  std::vector<kernels::Ray> out = rays.read();
  CHECK(out.back().t_min == 7);
  out.pop_back();
  return out;
}

bool same(const kernels::Ray& a, const kernels::Ray& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

TEST_CASE("Morton keys of directions are interleaved bits of their cells") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const std::vector<kernels::Ray> rays = rays_in_cube(333, 10, 1);
  for (const auto& [order, bins] : {std::pair{RayOrder::z, 1024u}, {RayOrder::hz, 16u}, {RayOrder::hz, 7u}}) {
    CAPTURE(bins);
    const std::vector<uint32_t> keys = keys_by(context, order, {.bins = order == RayOrder::z ? 16 : bins}, rays);
    size_t wrong = 0;
    for (size_t i = 0; i < rays.size(); ++i) wrong += keys[i] != interleaved(rays[i].direction, bins);
    CHECK(wrong == 0);
  }
}

TEST_CASE("Hilbert keys of a histogram visit each bin once, one step at a time") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  constexpr uint32_t bins = 8;
  std::vector<kernels::Ray> rays(bins * bins * bins);
  for (uint32_t i = 0; i < rays.size(); ++i)
    for (uint32_t d = 0, rest = i; d < 3; ++d, rest /= bins)
      rays[i].direction[d] = (static_cast<float>(rest % bins) + 0.5f) / (bins / 2) - 1;
  for (const RayOrder order : {RayOrder::h3dh, RayOrder::h3dh2dh, RayOrder::h3dh3dh}) {
    const std::vector<uint32_t> keys = keys_by(context, order, {.bins = bins}, rays);
    std::vector<uint32_t> ray_of(rays.size(), ~0u);
    for (uint32_t i = 0; i < rays.size(); ++i) ray_of.at(keys[i]) = i;
    REQUIRE(std::count(ray_of.begin(), ray_of.end(), ~0u) == 0);
    size_t jumps = 0;
    for (size_t k = 1; k < rays.size(); ++k) {
      float way = 0;
      for (int d = 0; d < 3; ++d) way += std::abs(rays[ray_of[k]].direction[d] - rays[ray_of[k - 1]].direction[d]);
      jumps += std::lround(way * (bins / 2)) != 1;
    }
    CHECK(jumps == 0);
  }
}

TEST_CASE("direction_origin orders by direction first, then by the cell of the origin") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  std::vector<kernels::Ray> rays = rays_in_cube(64, 10, 1);
  for (size_t i = 32; i < 64; ++i) std::memcpy(rays[i].direction, rays[i - 32].direction, sizeof rays[i].direction);
  const std::vector<uint32_t> keys = keys_by(context, RayOrder::direction_origin, {.extent = 10}, rays);
  size_t wrong = 0;
  for (size_t i = 0; i < 64; ++i) {
    float scaled[3];
    for (int d = 0; d < 3; ++d) scaled[d] = rays[i].origin[d] * (1.0f / 10);
    wrong += (keys[i] & 0xFFF) != interleaved(scaled, 16) || (i >= 32 && keys[i] >> 12 != keys[i - 32] >> 12);
  }
  CHECK(wrong == 0);
}

TEST_CASE("a launch is its parts, of unit length, from its origin, evenly in all octants or denser at the horizon") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  using kernels::LaunchMap;
  for (const LaunchMap map : {LaunchMap::hilbert, LaunchMap::horizon, LaunchMap::fibonacci, LaunchMap::random}) {
    CAPTURE(static_cast<int>(map));
    constexpr size_t n = 2000;
    kernels::GenerateRays launch(context, map, n, 5), other(context, map, n, 6);
    const std::vector<kernels::Ray> rays = launched(context, launch, 0, n), part = launched(context, launch, 777, 100);
    size_t wrong = 0, low = 0, octants[8] = {};
    for (size_t i = 0; i < n; ++i) {
      const Vec d = vec_of(rays[i].direction);
      wrong += std::abs(std::sqrt(dot(d, d)) - 1) > 1e-5 || rays[i].t_min != 0 || !std::isinf(rays[i].t_max);
      wrong += rays[i].origin[0] != 1 || rays[i].origin[1] != 2 || rays[i].origin[2] != 3;
      low += std::abs(d[2]) < 0.2;
      ++octants[(d[0] < 0) + 2 * (d[1] < 0) + 4 * (d[2] < 0)];
    }
    for (size_t i = 0; i < part.size(); ++i) wrong += !same(part[i], rays[777 + i]);
    CHECK(wrong == 0);
    const bool even = map != LaunchMap::horizon;
    const double low_share = static_cast<double>(low) / n;
    CHECK((even ? std::abs(low_share - 0.2) < 0.03 : low_share > 0.3));
    for (const size_t count : octants)
      if (even) CHECK(std::abs(static_cast<double>(count) / n - 0.125) < 0.03);
    const bool seeded = !same(launched(context, other, 0, 1)[0], rays[0]);
    CHECK(seeded == (map == LaunchMap::random));
  }
}

TEST_CASE("keys of launch indices are those of the rays that the launch would make") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  using kernels::LaunchMap;
  constexpr size_t launched_rays = 3000, first = 55, n = 333;
  const auto keys_of_launch = [&](RayOrder order, LaunchMap map) {
    kernels::LaunchKeys keys_of(context, order, map, launched_rays, 5);
    const auto keys = context.buffer<uint32_t>(n + 1);
    keys.write(std::vector<uint32_t>(n + 1, 7));
    keys_of(first, n, keys);
    std::vector<uint32_t> out = keys.read();
    CHECK(out.back() == 7);
    out.pop_back();
    for (const uint32_t key : out) REQUIRE(uint64_t{key} < uint64_t{1} << keys_of.bits());
    return out;
  };
  for (const LaunchMap map : {LaunchMap::hilbert, LaunchMap::horizon, LaunchMap::fibonacci, LaunchMap::random}) {
    CAPTURE(static_cast<int>(map));
    kernels::GenerateRays launch(context, map, launched_rays, 5);
    const std::vector<kernels::Ray> rays = launched(context, launch, first, n);
    const std::vector<uint32_t> z = keys_of_launch(RayOrder::z, map), hz = keys_of_launch(RayOrder::hz, map);
    size_t wrong = 0;
    for (size_t i = 0; i < n; ++i)
      wrong += z[i] != interleaved(rays[i].direction, 1024) || hz[i] != interleaved(rays[i].direction, 16);
    CHECK(wrong == 0);
    CHECK(keys_of_launch(RayOrder::h3dh, map) == keys_by(context, RayOrder::h3dh, {}, rays));
    // Cells of directions nest: a fourth of their sides makes those of queues, which have the cell of the origin below.
    std::vector<uint32_t> coarse = keys_of_launch(RayOrder::direction_origin, map),
                          queued = keys_by(context, RayOrder::direction_origin, {.extent = 10}, rays);
    for (uint32_t& key : coarse) key >>= 4;
    for (uint32_t& key : queued) key >>= 12;
    CHECK(coarse == queued);
  }
}

TEST_CASE("a launch in an order of the user's is that of its rays") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  constexpr size_t n = 333, first = 100;
  kernels::GenerateRays launch(context, kernels::LaunchMap::random, 500, 5);
  const std::vector<kernels::Ray> straight = launched(context, launch, first, n);
  std::vector<uint32_t> list(n);
  for (uint32_t i = 0; i < n; ++i) list[i] = i * 100 % n;
  const auto order = context.buffer<uint32_t>(n);
  const auto rays = context.buffer<kernels::Ray>(n + 1);
  order.write(list);
  rays.write(std::vector<kernels::Ray>(n + 1, {{7, 7, 7}, 7, {7, 7, 7}, 7}));
  launch({1, 2, 3}, first, order, n, rays);
  const std::vector<kernels::Ray> ordered = rays.read();
  size_t wrong = ordered[n].t_min != 7;
  for (size_t i = 0; i < n; ++i) wrong += !same(ordered[i], straight[list[i]]);
  CHECK(wrong == 0);
  CHECK(contains(message_of<kernels::Error>([&] {
                   launch({0, 0, 0}, 400, order, 101, rays);
                 }),
                 "rays 400 to 501 of a launch of 500"));
  CHECK(contains(message_of<kernels::Error>([&] { launch({0, 0, 0}, 0, order, n + 1, rays); }), "GenerateRays: order"));
}

TEST_CASE("faults of a user of OrderKeys, LaunchKeys and GenerateRays") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const auto made = [&](const kernels::OrderOptions& options) {
    return message_of<kernels::Error>([&] { kernels::OrderKeys(context, RayOrder::h3dh, options); });
  };
  CHECK(contains(made({.bins = 0}), "1 to 1024 bins"));
  CHECK(contains(made({.extent = -1}), "an extent of -1"));
  kernels::OrderKeys keys_of(context, RayOrder::h3dh);
  const auto planes = context.buffer<float>(96);
  const auto keys = context.buffer<uint32_t>(16);
  CHECK(contains(message_of<kernels::Error>([&] { keys_of(planes, 15, 15, keys); }), "a multiple of 16"));
  CHECK(contains(message_of<kernels::Error>([&] { keys_of(planes, 32, 16, keys); }), "OrderKeys: planes"));
  CHECK(contains(message_of<kernels::Error>([&] { kernels::GenerateRays(context, kernels::LaunchMap::random, 0); }),
                 "a launch of 0 rays"));
  kernels::GenerateRays launch(context, kernels::LaunchMap::random, 10);
  const auto rays = context.buffer<kernels::Ray>(10);
  CHECK(contains(message_of<kernels::Error>([&] { launch({0, 0, 0}, 5, 6, rays); }), "rays 5 to 11 of a launch of 10"));
  kernels::LaunchKeys launch_keys(context, RayOrder::z, kernels::LaunchMap::hilbert, 20);
  CHECK(contains(message_of<kernels::Error>([&] { launch_keys(0, 17, keys); }), "LaunchKeys: keys: the buffer has 64"));
  CHECK(contains(message_of<kernels::Error>([&] { launch_keys(4, 17, keys); }), "rays 4 to 21 of a launch of 20"));
  CHECK(contains(
      message_of<kernels::Error>([&] { kernels::LaunchKeys(context, RayOrder::z, kernels::LaunchMap::hilbert, 0); }),
      "LaunchKeys: a launch of 0 rays"));
}
