// SPDX-License-Identifier: Apache-2.0
// Launches by the names of arguments. tests/gpu/kernel_calls_test.py has what must not compile.
#include "gpu/kernel_of.hpp"
#include <doctest/doctest.h>
#include <stdexcept>
#include "gpu/temporary.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr const char* named_kernels = R"(
#ifdef MORE
#define ARGUMENTS const global uint* more,
#else
#define ARGUMENTS
#endif
kernel void weigh(const global float* words, global uint* out, ARGUMENTS uint count, ulong factor) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  out[i] = as_uint(words[i]) * (uint)factor;
#ifdef MORE
  out[i] += more ? more[i] : 1000;
#endif
}
)";

// The declaration of this kernel, as cmake/kernel_calls.py writes it.
struct Weigh {
  static constexpr const char* program_name = "named";
  static constexpr const char* kernel_name = "weigh";
  gpu::Global<const float> words;
  gpu::Global<uint32_t> out;
  std::optional<gpu::Global<const uint32_t>> more = {};
  gpu::Value<uint32_t> count;
  gpu::Value<uint64_t> factor;
  template <class Visit>
  void each(Visit&& visit) const {
    visit("words", words);
    visit("out", out);
    visit("more", more);
    visit("count", count);
    visit("factor", factor);
  }
};

struct NamedFixture {
  TemporaryKernels kernels;
  gpu::Context context;
  gpu::Buffer<uint32_t> words = context.buffer(std::vector<uint32_t>{1, 2, 3}, "words");
  gpu::Buffer<uint32_t> out = context.buffer(std::vector<uint32_t>{7, 7, 7}, "out");
  NamedFixture() { kernels.add("named.cl", named_kernels); }
  Weigh arguments() const {
    return {.words = gpu::Global<const float>::bits_of(words), .out = out, .count = 2u, .factor = 10u};
  }
};

}  // namespace

TEST_CASE_FIXTURE(NamedFixture, "a kernel is launched with the arguments of its declaration") {
  gpu::KernelOf<Weigh> weigh(context);
  weigh({3, 1}, Stage::transfer, arguments());
  CHECK(out.read() == std::vector<uint32_t>{10, 20, 7});
  weigh({0, 1}, Stage::transfer, arguments());
}

TEST_CASE_FIXTURE(NamedFixture, "arguments of some builds are given to those builds alone, and may be null") {
  gpu::KernelOf<Weigh> weigh(context), more(context, {{"MORE", "1"}});
  Weigh call = arguments();
  CHECK_THROWS_WITH_AS(more({3, 1}, Stage::transfer, call), "kernel weigh takes 5 arguments, 4 were given",
                       std::logic_error);
  call.more = words;
  more({3, 1}, Stage::transfer, call);
  CHECK(out.read() == std::vector<uint32_t>{11, 22, 7});
  call.more = nullptr;
  more({3, 1}, Stage::transfer, call);
  CHECK(out.read() == std::vector<uint32_t>{1010, 1020, 7});
  CHECK_THROWS_AS(weigh({3, 1}, Stage::transfer, call), std::logic_error);
}

TEST_CASE_FIXTURE(NamedFixture, "a kernel on the disk whose arguments changed places is refused") {
  std::string text = named_kernels;
  text.replace(text.find("uint count, ulong factor"), 24, "uint factor, ulong count");
  kernels.add("changed.cl", text);
  gpu::KernelOf<Weigh> weigh(context, {}, "changed");
  const std::string message = message_of<std::logic_error>([&] { weigh({3, 1}, Stage::transfer, arguments()); });
  CHECK(contains(message, "argument 2"));
  CHECK(contains(message, "`count`"));
  CHECK(out.read() == std::vector<uint32_t>{7, 7, 7});
}
