// SPDX-License-Identifier: Apache-2.0
// Tests of buffers, launches and profiles on a device.
// Uses the default device, Oclgrind's where the test runs under it.
#include <doctest/doctest.h>
#include <algorithm>
#include <numeric>
#include "expected_device.hpp"
#include "gpu/gpu.hpp"
#include "gpu/temporary.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr const char* launched_kernels = R"(
typedef struct { uint a, b, c; } three;
kernel void add(global uint* out, uint count, float4 unused, double factor) {
  const uint i = (uint)get_global_id(0);
  if (i < count) out[i] += (uint)factor * i;
}
kernel void ids(global uint* largest, uint unused) { atomic_max(largest, (uint)get_global_id(0)); }
kernel void records(global uint* out, three r) { out[0] = r.c; }
kernel void with_local(global uint* out, local uint* scratch) { out[0] = scratch[0]; }
)";

struct Fixture {
  TemporaryKernels kernels;
  gpu::Context context;
  Fixture() { kernels.add("test.cl", launched_kernels); }
  gpu::Kernel kernel(const char* name) { return context.kernel("test", name); }
};

struct float4 {
  float v[4];
};

}  // namespace

TEST_CASE("the device is of the platform that tests are meant for") {
  CHECK_NOTHROW(require_expected_platform(gpu::Context().info()));
}

TEST_CASE_FIXTURE(Fixture, "a buffer gives back what was written, in part or whole") {
  std::vector<uint32_t> data(100);
  std::iota(data.begin(), data.end(), 0u);
  auto buffer = context.buffer(data, "data");
  CHECK(buffer.size() == 100);
  CHECK(buffer.bytes() == 400);
  CHECK(buffer.read() == data);
  CHECK(buffer.read(10, 3) == std::vector<uint32_t>{10, 11, 12});
  CHECK(buffer.read_one(99) == 99);
  const std::vector<uint32_t> part{7, 8};
  buffer.write(part, 98);
  CHECK(buffer.read(97, 3) == std::vector<uint32_t>{97, 7, 8});
  CHECK(buffer.read(100, 0).empty());
}

TEST_CASE_FIXTURE(Fixture, "transfers outside a buffer name it and move nothing") {
  auto buffer = context.buffer(std::vector<uint32_t>(10, 1u), "small one");
  const std::vector<uint32_t> two{5, 5};
  for (const std::string& message : {message_of<std::out_of_range>([&] { buffer.write(two, 9); }),
                                     message_of<std::out_of_range>([&] { buffer.read(5, 6); }),
                                     message_of<std::out_of_range>([&] { buffer.read_one(10); }),
                                     message_of<std::out_of_range>([&] { buffer.read_one(SIZE_MAX / 4); })}) {
    CHECK(contains(message, "\"small one\""));
  }
  CHECK(buffer.read() == std::vector<uint32_t>(10, 1u));
  gpu::Buffer<uint32_t> none;
  CHECK_FALSE(none);
  CHECK_THROWS_AS(none.read_one(0), std::logic_error);
  CHECK_THROWS_AS(context.fill(none, 0u), std::logic_error);
  CHECK_THROWS_AS(none.read(1, 0), std::logic_error);
}

TEST_CASE_FIXTURE(Fixture, "over no elements nothing is launched or moved, with a buffer or without") {
  gpu::Buffer<uint32_t> none, to;
  CHECK(none.read().empty());
  CHECK_NOTHROW(none.write(std::vector<uint32_t>()));
  CHECK_NOTHROW(context.copy(none, to, 0));
  auto out = context.buffer(std::vector<uint32_t>(4, 7u), "out");
  gpu::Kernel add = kernel("add");
  for (const gpu::Range& range : {gpu::Range{0, 4}, gpu::Range({4, 0, 1}, {4, 1, 1}, 2)}) {
    CHECK_NOTHROW(add(range, Stage::transfer, out, 1u, float4{}, 1.0));
    CHECK_NOTHROW(add(range, Stage::transfer, none, 1u, float4{}, 1.0));
    CHECK_THROWS_AS(add(range, Stage::transfer, out), std::logic_error);
  }
  CHECK(out.read() == std::vector<uint32_t>(4, 7u));
}

TEST_CASE_FIXTURE(Fixture, "a buffer of no elements has no elements and can still be an argument") {
  auto empty = context.buffer<uint32_t>(0, "empty");
  CHECK(empty.size() == 0);
  CHECK(static_cast<bool>(empty));
  CHECK(empty.read().empty());
  CHECK_THROWS_AS(empty.read_one(0), std::out_of_range);
  context.fill(empty, 1u);
  kernel("add")({0, 64}, Stage::transfer, empty, 0u, float4{}, 1.0);
  kernel("add")({64, 64}, Stage::transfer, empty, 0u, float4{}, 1.0);
  context.finish();
  CHECK(context.buffer(std::vector<uint32_t>{}, "from nothing").size() == 1);
}

TEST_CASE_FIXTURE(Fixture, "fill repeats its pattern, copy copies, and both check their bounds") {
  auto words = context.buffer<uint32_t>(6, "words");
  context.fill(words, 0xdeadbeefu);
  CHECK(words.read() == std::vector<uint32_t>(6, 0xdeadbeefu));
  const uint64_t pattern = 0x0000000200000001ull;
  context.fill(words, &pattern, 8, 8, 16, Stage::transfer);
  CHECK(words.read() == std::vector<uint32_t>{0xdeadbeefu, 0xdeadbeefu, 1, 2, 1, 2});
  CHECK_THROWS_AS(context.fill(words, &pattern, 8, 4, 8, Stage::transfer), std::logic_error);
  CHECK_THROWS_AS(context.fill(words, &pattern, 3, 0, 3, Stage::transfer), std::logic_error);
  CHECK_THROWS_AS(context.fill(words, &pattern, 8, 24, 8, Stage::transfer), std::out_of_range);
  auto shorter = context.buffer(std::vector<uint32_t>{9, 9, 9}, "shorter");
  context.copy(words, shorter, 8);
  CHECK(shorter.read() == std::vector<uint32_t>{0xdeadbeefu, 0xdeadbeefu, 9});
  CHECK_THROWS_AS(context.copy(words, shorter, 16), std::out_of_range);
  CHECK_THROWS_AS(context.copy(shorter, words, 16), std::out_of_range);
}

TEST_CASE_FIXTURE(Fixture, "a fill of more elements than drivers can count is whole") {
  const size_t count = (size_t{1} << 30) + 12345;
  if (context.info().max_buffer < 2 * count) {
    MESSAGE("skipped: the device allows only ", context.info().max_buffer, " bytes a buffer");
    return;
  }
  auto bytes = context.buffer<uint8_t>(count, "bytes");
  context.fill(bytes, uint8_t{0});
  context.fill(bytes, uint8_t{0xa5});
  const size_t part = size_t{1} << 26;
  size_t wrong = 0;
  for (size_t first = 0; first < count; first += part) {
    const std::vector<uint8_t> read = bytes.read(first, std::min(part, count - first));
    wrong += read.size() - static_cast<size_t>(std::count(read.begin(), read.end(), 0xa5));
  }
  CHECK(wrong == 0);
  // Only an end is filled, at an offset that is no multiple of the seed's size.
  const uint64_t pattern = 0x0807060504030201ull;
  context.fill(bytes, &pattern, 1, count - 5, 5, Stage::transfer);
  CHECK(bytes.read(count - 6, 6) == std::vector<uint8_t>{0xa5, 1, 1, 1, 1, 1});
}

TEST_CASE_FIXTURE(Fixture, "a buffer larger than the device allows is an error that says what to lower") {
  const std::string message = message_of<DeviceError>(
      [&] { context.buffer<uint8_t>(static_cast<size_t>(context.info().max_buffer) + 1, "ray queue"); });
  CHECK(contains(message, "\"ray queue\""));
  CHECK(contains(message, std::to_string(context.info().max_buffer)));
  CHECK(contains(message, "trace.batch_rays"));
  CHECK(contains(message, context.info().name));
  const std::string other = message_of<gpu::BufferError>([&] {
    context.buffer<uint8_t>(static_cast<size_t>(context.info().max_buffer) + 1, {"tiles", "Raise trace.tile_m"});
  });
  CHECK(contains(other, "\"tiles\""));
  CHECK(contains(other, ". Raise trace.tile_m"));
  CHECK_FALSE(contains(other, "trace.batch_rays"));
}

TEST_CASE_FIXTURE(Fixture, "a launch covers its range, padded to whole work-groups") {
  auto out = context.buffer(std::vector<uint32_t>(100, 1u), "out");
  kernel("add")({100, 64}, Stage::transfer, out, 100u, float4{}, 3.0);
  std::vector<uint32_t> expected(100);
  for (uint32_t i = 0; i < 100; ++i) expected[i] = 1 + 3 * i;
  CHECK(out.read() == expected);
  auto largest = context.buffer(std::vector<uint32_t>{0}, "largest");
  kernel("ids")({100, 64}, Stage::transfer, largest, 0u);
  CHECK(largest.read_one(0) == 127);
}

TEST_CASE_FIXTURE(Fixture, "an empty range launches nothing, with its arguments checked all the same") {
  auto largest = context.buffer(std::vector<uint32_t>{7}, "largest");
  kernel("ids")({0, 64}, Stage::transfer, largest, 0u);
  CHECK(largest.read_one(0) == 7);
  CHECK_THROWS_AS(kernel("ids")({0, 64}, Stage::transfer, largest), std::logic_error);
  CHECK_THROWS_AS(kernel("ids")({1, 0}, Stage::transfer, largest, 0u), std::logic_error);
}

TEST_CASE_FIXTURE(Fixture, "wrong arguments are named") {
  auto out = context.buffer(std::vector<uint32_t>(4), "out");
  gpu::Kernel add = kernel("add");
  CHECK(add.name() == "add");
  const gpu::Range one{1, 1};
  const std::string count = message_of<std::logic_error>([&] { add(one, Stage::transfer, out, 1u); });
  CHECK(contains(count, "kernel add takes 4 arguments, 2 were given"));
  const std::string size =
      message_of<std::logic_error>([&] { add(one, Stage::transfer, out, uint64_t{1}, float4{}, 1.0); });
  CHECK(contains(size, "argument 1"));
  CHECK(contains(size, "kernel add"));
  const std::string vector_size = message_of<std::logic_error>([&] { add(one, Stage::transfer, out, 1u, 1.0f, 1.0); });
  CHECK(contains(vector_size, "argument 2"));
  const std::string not_a_buffer =
      message_of<std::logic_error>([&] { add(one, Stage::transfer, uint64_t{0}, 1u, float4{}, 1.0); });
  CHECK(contains(not_a_buffer, "argument 0"));
  const std::string not_a_value =
      message_of<std::logic_error>([&] { add(one, Stage::transfer, out, out, float4{}, 1.0); });
  CHECK(contains(not_a_value, "argument 1"));
  const gpu::Buffer<uint32_t>* const absent = nullptr;  // fits if there is memory
  const std::string no_buffer =
      message_of<std::logic_error>([&] { add(one, Stage::transfer, out, absent, float4{}, 1.0); });
  CHECK(contains(no_buffer, "argument 1"));
  const std::string unallocated =
      message_of<std::logic_error>([&] { add(one, Stage::transfer, gpu::Buffer<uint32_t>(), 1u, float4{}, 1.0); });
  CHECK(contains(unallocated, "argument 0"));
  CHECK(contains(unallocated, "never allocated"));
  gpu::Kernel never_made;
  CHECK_THROWS_AS(never_made(one, Stage::transfer), std::logic_error);
}

TEST_CASE_FIXTURE(Fixture, "records are passed by value, local pointers and buffers of other contexts are refused") {
  auto out = context.buffer(std::vector<uint32_t>(1), "out");
  struct Three {
    uint32_t a, b, c;
  };
  kernel("records")({1, 1}, Stage::transfer, out, Three{1, 2, 3});
  CHECK(out.read_one(0) == 3);
  CHECK_THROWS_AS(kernel("with_local")({1, 1}, Stage::transfer, out, 64u), std::logic_error);
  gpu::Context other;
  auto foreign = other.buffer(std::vector<uint32_t>(1), "foreign");
  CHECK_THROWS_AS(kernel("records")({1, 1}, Stage::transfer, foreign, Three{1, 2, 3}), std::logic_error);
}

TEST_CASE_FIXTURE(Fixture,
                  "a work-group larger than the device allows is an error that names the kernel and the range") {
  auto largest = context.buffer(std::vector<uint32_t>{0}, "largest");
  const size_t too_large = 2 * context.info().max_work_group;
  const std::string message = message_of<DeviceError>([&] {
    kernel("ids")({1, too_large}, Stage::transfer, largest, 0u);
  });
  CHECK(contains(message, "kernel ids"));
  CHECK(contains(message, std::to_string(too_large)));
  CHECK(contains(message, "CL_INVALID_WORK_"));  // ..._GROUP_SIZE, or ..._ITEM_SIZE: both limits are exceeded
}

TEST_CASE_FIXTURE(Fixture, "profiles sum by stage, over more launches than events are kept") {
  auto largest = context.buffer(std::vector<uint32_t>{0}, "largest");
  gpu::Kernel ids = kernel("ids");
  context.reset_profile();
  CHECK(context.profile().empty());
  for (int i = 0; i < 5000; ++i) ids({1, 1}, Stage::trace, largest, 0u);
  ids({64, 64}, Stage::solve, largest, 0u);
  largest.read_one(0);
  const auto profile = context.profile();
  REQUIRE(profile.size() == 3);
  CHECK(profile.at("trace") > 0);
  CHECK(profile.at("solve") > 0);
  CHECK(profile.at("trace") > profile.at("solve"));
  CHECK(profile.at("transfer") >= 0);
  CHECK(context.profile() == profile);
  const KernelTimes times = context.kernel_times();
  REQUIRE(times.size() == 1);
  const auto& [name, time] = *times.begin();
  CHECK(name.ends_with("/ids"));
  CHECK(time.launches == 5001);
  CHECK(time.items == 5064);
  CHECK(time.seconds == doctest::Approx(profile.at("trace") + profile.at("solve")));
  context.reset_profile();
  CHECK(context.profile().empty());
  CHECK(context.kernel_times().empty());
}

TEST_CASE_FIXTURE(Fixture, "buffers and kernels may outlive what made them, if only to be released") {
  gpu::Buffer<uint32_t> buffer;
  gpu::Kernel made;
  {
    gpu::Context inner;
    buffer = inner.buffer(std::vector<uint32_t>(4), "outliving");
    made = inner.kernel("test", "ids");
  }
  CHECK(buffer.size() == 4);
  CHECK(made.name() == "ids");
}
