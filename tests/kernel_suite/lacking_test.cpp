// SPDX-License-Identifier: Apache-2.0
// A device without double precision and 64-bit atomics: the passes that need neither give right results there, and the
// others are refused with the device, what it lacks and what to do. It is a device of this machine whose answers to
// clGetDeviceInfo are changed: this program's own function stands before that of the OpenCL loader.
#include <dlfcn.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>

#include "contains.hpp"
#include "gpu/temporary.hpp"
#include "kernel_suite/soup.hpp"
#include "kernel_suite/user.hpp"
#include "wavetracer/kernels/kernels.hpp"

namespace {

bool pretend = true;

// Takes whole words out of a list with blanks.
std::string without(const std::string& list, const std::string& beginning) {
  std::string out;
  for (size_t at = 0; at < list.size();) {
    const size_t end = std::min(list.find(' ', at), list.size());
    const std::string word = list.substr(at, end - at);
    if (word.find(beginning) != 0) out += (out.empty() ? "" : " ") + word;
    at = end + 1;
  }
  return out;
}

}  // namespace

extern "C" CL_API_ENTRY cl_int CL_API_CALL clGetDeviceInfo(cl_device_id device, cl_device_info name, size_t room,
                                                           void* value, size_t* size) {
  using Function = cl_int (*)(cl_device_id, cl_device_info, size_t, void*, size_t*);
  static const auto ask = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "clGetDeviceInfo"));
  if (!pretend || (name != CL_DEVICE_EXTENSIONS && name != CL_DEVICE_DOUBLE_FP_CONFIG))
    return ask(device, name, room, value, size);
  if (name == CL_DEVICE_DOUBLE_FP_CONFIG) {
    if (size) *size = sizeof(cl_device_fp_config);
    if (value && room < sizeof(cl_device_fp_config)) return CL_INVALID_VALUE;
    if (value) std::memset(value, 0, sizeof(cl_device_fp_config));
    return CL_SUCCESS;
  }
  size_t length = 0;
  if (const cl_int code = ask(device, name, 0, nullptr, &length); code != CL_SUCCESS) return code;
  std::string list(length, '\0');
  if (const cl_int code = ask(device, name, length, list.data(), nullptr); code != CL_SUCCESS) return code;
  list.resize(std::strlen(list.c_str()));
  list = without(without(list, "cl_khr_fp64"), "cl_khr_int64");
  if (size) *size = list.size() + 1;
  if (value && room < list.size() + 1) return CL_INVALID_VALUE;
  if (value) std::memcpy(value, list.c_str(), list.size() + 1);
  return CL_SUCCESS;
}

using namespace wavetracer::test;
namespace kernels = wavetracer::kernels;

TEST_CASE("trees and ray caches are refused on a device that lacks what they need") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const auto tree = [](const kernels::Context& of) {
    return message_of<kernels::Error>([&] { kernels::Bvh(of, soup(2, 1, 1, 1)); });
  };
  const auto cache = [&] {
    wavetracer::CacheConfig config;
    config.kind = "concurrent";
    config.key = "exact";
    return message_of<kernels::Error>([&] { kernels::RayCache(context, config, size_t{2}); });
  };
  CHECK(contains(tree(context), "Bvh: " + context.name() + " ("));
  CHECK(contains(tree(context), "lacks double precision (cl_khr_fp64); choose another device"));
  CHECK(contains(cache(), "RayCache: " + context.name() + " ("));
  CHECK(contains(cache(), "lacks 64-bit atomics (cl_khr_int64_base_atomics); choose another device"));
  pretend = false;  // the same device with all that it has
  const kernels::Context whole(user.context, user.device, user.queue);
  pretend = true;
  kernels::Bvh(whole, soup(2, 1, 1, 1));
}

TEST_CASE("sorts, scans and compaction need neither double precision nor 64-bit atomics") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  std::vector<uint64_t> numbers = random_keys<uint64_t>(3000);
  const auto keys = context.buffer<uint64_t>(numbers.size());
  keys.write(numbers);
  kernels::Sort sort(context, {.key_bits = 64, .method = kernels::SortMethod::radix});
  sort(keys, numbers.size());
  std::sort(numbers.begin(), numbers.end());
  CHECK(keys.read() == numbers);

  std::vector<uint32_t> words = random_keys<uint32_t>(3000), places, sums(3000);
  for (uint32_t i = 0; i < 3000; i += 3) words[i] = kernels::nothing;
  for (uint32_t i = 0; i < 3000; ++i)
    if (words[i] != kernels::nothing) places.push_back(i);
  const auto data = context.buffer<uint32_t>(3000), indices = context.buffer<uint32_t>(3000),
             total = context.buffer<uint32_t>(1);
  data.write(words);
  kernels::Compact compact(context);
  compact(data, 3000, indices, total);
  REQUIRE(total.read()[0] == places.size());
  CHECK(indices.read(0, places.size()) == places);
  kernels::Scan scan(context);
  scan(data, 3000, total);
  std::exclusive_scan(words.begin(), words.end(), sums.begin(), 0u);
  CHECK(data.read() == sums);
}

TEST_CASE("keys along curves and orders of launches need neither") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const auto points = context.buffer<float>(64);
  std::vector<float> line(64);
  for (uint32_t i = 0; i < 32; ++i) line[2 * i] = line[2 * i + 1] = (static_cast<float>(i) + 0.5f) / 32;
  points.write(line);
  const auto codes = context.buffer<uint64_t>(32);
  const std::vector<float> lower{0, 0}, upper{1, 1};
  kernels::CurveKeys(context, kernels::Curve::morton2, 64)(points, 32, {lower, upper, 32}, codes);
  const std::vector<uint64_t> along = codes.read();
  for (uint64_t i = 0; i < 32; ++i) {  // on the diagonal each bit comes twice
    uint64_t expected = 0;
    for (unsigned bit = 0; bit < 5; ++bit) expected |= (i >> bit & 1) * 3 << 2 * bit;
    CHECK(along[i] == expected);
  }
  constexpr size_t n = 200;
  const auto rays = context.buffer<kernels::Ray>(n);
  const auto of_rays = context.buffer<uint32_t>(n), of_launch = context.buffer<uint32_t>(n);
  kernels::GenerateRays(context, kernels::LaunchMap::fibonacci, n)({0, 0, 0}, 0, n, rays);
  kernels::OrderKeys(context, kernels::RayOrder::z)(rays, n, of_rays);
  kernels::LaunchKeys(context, kernels::RayOrder::z, kernels::LaunchMap::fibonacci, n)(0, n, of_launch);
  const std::vector<uint32_t> found = of_rays.read();
  CHECK(found == of_launch.read());
  CHECK(std::count(found.begin(), found.end(), found[0]) < 3);  // directions differ
}
