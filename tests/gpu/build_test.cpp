// SPDX-License-Identifier: Apache-2.0
// Tests of programs: definitions, build errors that point to file and line, and the cache on disk with real binaries.
// Uses the default device, Oclgrind's where the test runs under it.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>
#include <cmath>
#include <cstdio>
#include "gpu/gpu.hpp"
#include "gpu/temporary.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr const char* value_kernels = R"(
kernel void value(global uint* out) { out[0] = VALUE; }
kernel void environment(global uint* out) {
#if defined(WT_CPU) && !defined(WT_GPU) || defined(WT_GPU) && !defined(WT_CPU)
  out[0] = 1;
#endif
  out[1] = 0;
#ifdef WT_BACKEND_C11_CL3
  out[1] += 1;
#endif
#ifdef WT_BACKEND_C11_CL2
  out[1] += 1;
#endif
#ifdef WT_BACKEND_LEGACY
  out[1] += 1;
#endif
}
)";

uint32_t run_value(gpu::Context& context, const char* value) {
  auto out = context.buffer(std::vector<uint32_t>{0}, "out");
  context.kernel("test", "value", {{"VALUE", value}})({1, 1}, Stage::transfer, out);
  return out.read_one(0);
}

std::vector<std::filesystem::path> cached_files(const TemporaryKernels& kernels) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(kernels.cache() / "wavetracer" / "programs")) {
    files.push_back(entry.path());
  }
  return files;
}

}  // namespace

TEST_CASE("definitions make different programs, each built once a context") {
  const TemporaryKernels kernels;
  kernels.add("test.cl", value_kernels);
  gpu::Context context;
  CHECK(run_value(context, "5") == 5);
  CHECK(run_value(context, "6") == 6);
  CHECK(run_value(context, "5") == 5);
  CHECK(context.builds_from_source() == 2);
  CHECK(context.build_seconds() > 0);
  CHECK_THROWS_AS(run_value(context, "1 2"), std::logic_error);
}

TEST_CASE("a program knows its kind of device and exactly one back-end of memory order") {
  const TemporaryKernels kernels;
  kernels.add("test.cl", value_kernels);
  gpu::Context context;
  auto out = context.buffer(std::vector<uint32_t>{0, 0}, "out");
  context.kernel("test", "environment", {{"VALUE", "0"}})({1, 1}, Stage::transfer, out);
  CHECK(out.read() == std::vector<uint32_t>{1, 1});
}

TEST_CASE("warnings of kernels are not shown to users") {
  const TemporaryKernels kernels;
  kernels.add("test.cl", "#warning some words\n" + std::string(value_kernels));
  const std::filesystem::path shown = kernels.kernels() / "stderr";
  gpu::Context context;
  if (context.info().platform == "Oclgrind") {
    MESSAGE("skipped: Oclgrind takes no option that keeps its compiler quiet");
    return;
  }
  std::fflush(stderr);
  const int before = ::dup(STDERR_FILENO), file = ::open(shown.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  REQUIRE(before >= 0);
  REQUIRE(file >= 0);
  ::dup2(file, STDERR_FILENO);
  ::close(file);
  const uint32_t value = run_value(context, "7");
  std::fflush(stderr);
  ::dup2(before, STDERR_FILENO);
  ::close(before);
  CHECK(value == 7);
  CHECK(read_file(shown) == "");
}

TEST_CASE("contraction can be turned off, and single-precision division and square roots can be exact") {
  const TemporaryKernels kernels;
  kernels.add("test.cl", R"(
#pragma OPENCL FP_CONTRACT OFF
kernel void arithmetic(global const float* in, global float* out) {
  out[0] = in[0] * in[1] + in[2];
  out[1] = in[3] / in[4];
  out[2] = sqrt(in[3]);
})");
  gpu::Context context;
  // (1 + e)^2 = 1 + 2e + e^2 rounds to 1 + 2e: the difference is 0 unless the product was kept unrounded.
  const float e = 1.0f / 4096;
  const std::vector<float> in{1 + e, 1 + e, -(1 + 2 * e), 10.0f, 3.0f};
  auto input = context.buffer(in, "in");
  auto out = context.buffer<float>(3, "out");
  context.kernel("test", "arithmetic")({1, 1}, Stage::transfer, input, out);
  CHECK(out.read_one(0) == 0.0f);
  if (context.info().correctly_rounded_divide) {
    CHECK(out.read_one(1) == 10.0f / 3.0f);
    CHECK(out.read_one(2) == std::sqrt(10.0f));
  }
}

TEST_CASE("a program that does not build is an error with its name, options and the log's file and line") {
  const TemporaryKernels kernels;
  kernels.add("broken.cl",
              "#include \"lib/fine.clh\"\n\nkernel void k(global uint* out) {\n  out[0] = undeclared_name;\n}\n");
  kernels.add("lib/fine.clh", "// one\n// two\n// three\n");
  gpu::Context context;
  auto out = context.buffer<uint32_t>(1, "out");
  const std::string message = message_of<DeviceError>([&] {
    context.kernel("broken", "k", {{"SOME_DEFINITION", "3"}})({1, 1}, Stage::transfer, out);
  });
  CHECK(contains(message, "\"broken\""));
  CHECK(contains(message, "-DSOME_DEFINITION=3"));
  CHECK(contains(message, "undeclared_name"));
  CHECK(contains(message, context.info().name));
  CHECK(contains(message, (kernels.kernels() / "broken.cl").string() + ":4"));
  kernels.add("broken.cl", "kernel void k(global uint* out) { out[0] = 1; }\n");
  CHECK_NOTHROW(context.kernel("broken", "k")({1, 1}, Stage::transfer, out));
  CHECK(contains(message_of<DeviceError>([&] {
                   context.kernel("broken", "absent")({1, 1}, Stage::transfer, out);
                 }),
                 "\"absent\""));
}

TEST_CASE("a second context takes the program from disk, and it computes the same") {
  const TemporaryKernels kernels;
  kernels.add("test.cl", value_kernels);
  gpu::Context first;
  CHECK(run_value(first, "11") == 11);
  CHECK(first.builds_from_source() == 1);
  REQUIRE(cached_files(kernels).size() == 1);
  gpu::Context second;
  CHECK(run_value(second, "11") == 11);
  CHECK(second.builds_from_source() == 0);
  CHECK_THROWS_AS(second.kernel("test", "value", {{"VALUE", "11"}})({1, 1}, Stage::transfer), std::logic_error);

  // Another source under the same program name is another program.
  kernels.add("test.cl", std::string(value_kernels) + "// changed\n");
  gpu::Context third;
  CHECK(run_value(third, "11") == 11);
  CHECK(third.builds_from_source() == 1);
}

TEST_CASE("a cached program that is damaged, or that the driver refuses, is rebuilt and replaced") {
  const TemporaryKernels kernels;
  kernels.add("test.cl", value_kernels);
  {
    gpu::Context context;
    CHECK(run_value(context, "12") == 12);
  }
  const std::filesystem::path file = cached_files(kernels).at(0);
  const std::string whole = read_file(file);
  std::string changed = whole;
  changed.back() = static_cast<char>(changed.back() ^ 1);
  for (const std::string& damaged : {whole.substr(0, whole.size() / 2), std::string(), changed}) {
    write_file(file, damaged);
    gpu::Context rebuilt;
    CHECK(run_value(rebuilt, "12") == 12);
    CHECK(rebuilt.builds_from_source() == 1);
    gpu::Context cached;
    CHECK(run_value(cached, "12") == 12);
    CHECK(cached.builds_from_source() == 0);
  }
}

TEST_CASE("without a cache, or with one that cannot be written, programs are built from source") {
  const TemporaryKernels kernels;
  kernels.add("test.cl", value_kernels);
  {
    const Environment off("WAVETRACER_NO_CACHE", "1");
    for (int i = 0; i < 2; ++i) {
      gpu::Context context;
      CHECK(run_value(context, "13") == 13);
      CHECK(context.builds_from_source() == 1);
    }
    CHECK_FALSE(std::filesystem::exists(kernels.cache()));
  }
  write_file(kernels.kernels() / "a_file", "");
  const Environment under_a_file("XDG_CACHE_HOME", (kernels.kernels() / "a_file").c_str());
  gpu::Context context;
  CHECK(run_value(context, "13") == 13);
  CHECK(context.builds_from_source() == 1);
}
