// SPDX-License-Identifier: Apache-2.0
// The public Bvh against all triangles in turn, in the user's own queue and memory.
#include "wavetracer/kernels/bvh.hpp"

#include <doctest/doctest.h>

#include "contains.hpp"
#include "gpu/temporary.hpp"
#include "kernel_suite/soup.hpp"
#include "kernel_suite/user.hpp"

using namespace wavetracer::test;
namespace kernels = wavetracer::kernels;

namespace {

// Counts wrong answers of nearest() and any() for rays in memory of the user's own; the last element must stay.
size_t wrong_answers(const User& user, const kernels::Context& context, kernels::Bvh& bvh,
                     const std::vector<float>& corners, const std::vector<kernels::Ray>& rays, size_t* certain) {
  const size_t n = rays.size();
  const cl_mem own_rays = user.memory(rays), own_hits = user.memory((n + 1) * sizeof(kernels::Hit));
  const auto from = context.wrap<kernels::Ray>(own_rays);
  const auto to = context.wrap<kernels::Hit>(own_hits);
  const auto met = context.buffer<uint32_t>(n + 1);
  to.write(std::vector<kernels::Hit>(n + 1, {7, 7, 7, 7}));
  met.write(std::vector<uint32_t>(n + 1, 7));
  bvh.nearest(from, n, to);
  bvh.any(from, n, met);
  const std::vector<kernels::Hit> hits = user.read<kernels::Hit>(own_hits, n + 1);
  const std::vector<uint32_t> any = met.read();
  clReleaseMemObject(own_rays);
  clReleaseMemObject(own_hits);
  size_t wrong = hits[n].t != 7 || any[n] != 7;
  for (size_t i = 0; i < n; ++i) {
    const Nearest expected = nearest_of(corners, rays[i]);
    wrong += any[i] != (hits[i].missed() ? 0u : 1u);
    if (!expected.certain) continue;
    ++*certain;
    wrong += differs(hits[i], expected) || std::abs(hits[i].u - expected.u) > 1e-2 ||
             std::abs(hits[i].v - expected.v) > 1e-2;
  }
  return wrong;
}

}  // namespace

TEST_CASE("nearest and any hits of a user's triangles are those of Möller and Trumbore's test") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const std::vector<float> corners = soup(150, 10, 3, 1);
  std::vector<kernels::Ray> rays = rays_in_cube(300, 15, 2);
  for (size_t i = 0; i < rays.size(); i += 3) {
    rays[i].t_min = 2;
    rays[i].t_max = 9;
  }
  for (const bool splits : {false, true}) {
    kernels::Bvh bvh(context, corners, {.spatial_splits = splits, .reach = 15});
    CHECK(bvh.triangles() == 150);
    size_t certain = 0;
    CHECK(wrong_answers(user, context, bvh, corners, rays, &certain) == 0);
    CHECK(certain > 270);
  }
}

TEST_CASE("triangles by their vertices are the same triangles; there may be none") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const std::vector<float> vertices = soup(4, 5, 5, 3);  // twelve of them
  const std::vector<uint32_t> indices{0, 1, 2, 2, 1, 3, 4, 5, 6, 7, 8, 9, 11, 10, 0};
  std::vector<float> corners;
  for (const uint32_t index : indices)
    for (size_t axis = 0; axis < 3; ++axis) corners.push_back(vertices[3 * index + axis]);
  const std::vector<kernels::Ray> rays = rays_in_cube(200, 8, 4);
  size_t certain = 0;
  kernels::Bvh indexed(context, vertices, indices, {.reach = 8});
  CHECK(indexed.triangles() == 5);
  CHECK(wrong_answers(user, context, indexed, corners, rays, &certain) == 0);
  kernels::Bvh empty(context, std::vector<float>{});
  CHECK(empty.triangles() == 0);
  CHECK(wrong_answers(user, context, empty, {}, rays, &certain) == 0);
}

TEST_CASE("packets of rays meet what single rays meet, on CPUs") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  kernels::Bvh bvh(context, soup(200, 10, 3, 5), {.reach = 15});
  const std::vector<kernels::Ray> rays = rays_in_cube(333, 15, 6);
  const auto from = context.buffer<kernels::Ray>(rays.size());
  const auto single = context.buffer<kernels::Hit>(rays.size()), packed = context.buffer<kernels::Hit>(rays.size());
  from.write(rays);
  cl_device_type type = 0;
  check_code(clGetDeviceInfo(user.device, CL_DEVICE_TYPE, sizeof type, &type, nullptr), "clGetDeviceInfo");
  if (!(type & CL_DEVICE_TYPE_CPU)) {
    CHECK(contains(message_of<kernels::Error>([&] { bvh.nearest_in_packets(from, 1, packed); }), "for CPUs"));
    return;
  }
  bvh.nearest(from, rays.size(), single);
  bvh.nearest_in_packets(from, rays.size(), packed);
  const std::vector<kernels::Hit> a = single.read(), b = packed.read();
  size_t different = 0, met = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    different += a[i].triangle != b[i].triangle || a[i].t != b[i].t || b[i].u != 0;
    met += !a[i].missed();
  }
  CHECK(different == 0);
  CHECK(met > 50);
}

TEST_CASE("faults of a user of Bvh: what is no triangle, no vertex, no buffer") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const auto message = [&](const std::vector<float>& corners) {
    return message_of<kernels::Error>([&] { kernels::Bvh(context, corners); });
  };
  CHECK(contains(message(std::vector<float>(10)), "Bvh: 10 floats"));
  std::vector<float> corners = soup(2, 1, 1, 1);
  corners[12] = std::numeric_limits<float>::quiet_NaN();
  CHECK(contains(message(corners), "triangle 1 has the coordinate nan"));
  CHECK(contains(message_of<kernels::Error>([&] {
                   kernels::Bvh(context, std::vector<float>(9), std::vector<uint32_t>{0, 1, 3});
                 }),
                 "vertex 3 of 3"));
  kernels::Bvh bvh(context, soup(2, 1, 1, 1));
  const auto rays = context.buffer<kernels::Ray>(4);
  const auto hits = context.buffer<kernels::Hit>(3);
  CHECK(
      contains(message_of<kernels::Error>([&] { bvh.nearest(rays, 4, hits); }), "Bvh: hits: the buffer has 48 bytes"));
}
