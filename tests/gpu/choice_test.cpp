// SPDX-License-Identifier: Apache-2.0
// Tests of the choice of a device by text, on invented machines.
// No device is needed.
#include <doctest/doctest.h>
#include "gpu/gpu.hpp"
#include "gpu/temporary.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using gpu::choose_device;
using gpu::DeviceInfo;

namespace {

DeviceInfo device(size_t index, const char* platform, const char* name, bool is_gpu) {
  DeviceInfo info;
  info.index = index;
  info.platform = platform;
  info.name = name;
  info.gpu = is_gpu;
  info.cpu = !is_gpu;
  return info;
}

const std::vector<DeviceInfo> machine{device(0, "Portable Computing Language", "pthread-EPYC", false),
                                      device(1, "NVIDIA CUDA", "NVIDIA H200", true),
                                      device(2, "NVIDIA CUDA", "NVIDIA RTX 4090", true)};

}  // namespace

TEST_CASE("without a text a GPU goes before a CPU, whatever their order") {
  CHECK(choose_device(machine, "") == 1);
  CHECK(choose_device({machine[0]}, "") == 0);
  CHECK(choose_device({machine[0], machine[0]}, "") == 0);
}

TEST_CASE("a text matches part of a platform or name in any case, a number an index") {
  CHECK(choose_device(machine, "portable") == 0);
  CHECK(choose_device(machine, "EPYC") == 0);
  CHECK(choose_device(machine, "nvidia") == 1);
  CHECK(choose_device(machine, "rtx 4090") == 2);
  CHECK(choose_device(machine, "e") == 0);  // no GPU has the letter e
  CHECK(choose_device(machine, "p") == 0);
  CHECK(choose_device(machine, "a") == 1);  // all names have it: a GPU is preferred
  CHECK(choose_device(machine, "2") == 2);
}

TEST_CASE("no match is an error with the list, no device one that says what to install") {
  for (const char* text : {"radeon", "3", "99999999999999999999999"}) {
    const std::string message = message_of<DeviceError>([&] { choose_device(machine, text); });
    CHECK(contains(message, text));
    CHECK(contains(message, "0: pthread-EPYC (Portable Computing Language)"));
    CHECK(contains(message, "2: NVIDIA RTX 4090 (NVIDIA CUDA)"));
  }
  const std::string none = message_of<DeviceError>([] { choose_device({}, ""); });
  CHECK(contains(none, "pocl-opencl-icd"));
  CHECK(contains(none, "OCL_ICD_VENDORS"));
}

TEST_CASE("a device lacks the needs that it does not meet, and nothing that nobody needs") {
  const std::string fp64 = "double precision (cl_khr_fp64)", atomics = "64-bit atomics (cl_khr_int64_base_atomics)";
  DeviceInfo plain;
  CHECK(gpu::lacks(plain) == fp64 + " and " + atomics);
  CHECK(gpu::lacks(plain, {.fp64 = false}) == atomics);
  CHECK(gpu::lacks(plain, {.int64_atomics = false}) == fp64);
  CHECK(gpu::lacks(plain, {.fp64 = false, .int64_atomics = false}).empty());
  plain.fp64 = true;
  CHECK(gpu::lacks(plain) == atomics);
  plain.int64_atomics = true;
  CHECK(gpu::lacks(plain).empty());
}
