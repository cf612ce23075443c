// SPDX-License-Identifier: Apache-2.0
// Tests that a context uses the handles of a user, refuses wrong ones with advice, and keeps none longer than it must.
#include "wavetracer/kernels/context.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "contains.hpp"
#include "gpu/temporary.hpp"
#include "kernel_suite/user.hpp"
#include "wavetracer/kernels/kernels.hpp"

using namespace wavetracer::test;
namespace kernels = wavetracer::kernels;

namespace {

cl_uint references(cl_command_queue queue) {
  cl_uint count = 0;
  check_code(clGetCommandQueueInfo(queue, CL_QUEUE_REFERENCE_COUNT, sizeof count, &count, nullptr),
             "clGetCommandQueueInfo");
  return count;
}

template <class Function>
std::string refusal(const Function& function) {
  return message_of<kernels::Error>(function);
}

}  // namespace

TEST_CASE("the user's memory is sorted in the user's queue without a copy") {
  const User user;
  std::vector<uint32_t> keys = random_keys<uint32_t>(5000);
  const cl_mem memory = user.memory(keys);
  kernels::Context context(user.context, user.device, user.queue);
  CHECK(context.context() == user.context);
  CHECK(context.device() == user.device);
  CHECK(context.queue() == user.queue);
  CHECK_FALSE(context.name().empty());
  const auto wrapped = context.wrap<uint32_t>(memory);
  CHECK(wrapped.handle() == memory);
  CHECK(wrapped.size() == 5000);
  kernels::Sort sort(context, {});
  sort(wrapped, keys.size());
  std::sort(keys.begin(), keys.end());
  CHECK(user.read<uint32_t>(memory, keys.size()) == keys);  // by the user's own call
  CHECK(wrapped.read() == keys);
  clReleaseMemObject(memory);
}

TEST_CASE("handles are retained while they are used, and no longer") {
  User user;
  std::vector<uint32_t> keys = random_keys<uint32_t>(100);
  const cl_mem memory = user.memory(keys);
  const cl_uint before = references(memory), queue_before = references(user.queue);
  {
    auto context = std::make_unique<kernels::Context>(user.context, user.device, user.queue);
    CHECK(references(user.queue) > queue_before);
    auto wrapped = context->wrap<uint32_t>(memory);
    CHECK(references(memory) == before + 1);
    kernels::Sort sort(*context, {});
    context.reset();  // passes and buffers outlive it
    sort(wrapped, keys.size());
    std::sort(keys.begin(), keys.end());
    CHECK(wrapped.read() == keys);
    const kernels::Buffer<uint32_t> copy = wrapped;
    CHECK(copy.handle() == memory);
    CHECK(references(memory) == before + 1);
  }
  CHECK(references(memory) == before);
  CHECK(references(user.queue) == queue_before);

  // The user may release everything first.
  kernels::Context context(user.context, user.device, user.queue);
  const auto wrapped = context.wrap<uint32_t>(memory);
  clReleaseMemObject(memory);
  clReleaseCommandQueue(user.queue);
  clReleaseContext(user.context);
  user.queue = nullptr;
  user.context = nullptr;
  CHECK(wrapped.read() == keys);
}

TEST_CASE("wrong handles are refused, and the message says what to do") {
  const User user, other;
  CHECK(contains(refusal([&] { kernels::Context(nullptr, user.device, user.queue); }), "the cl_context is null"));
  CHECK(contains(refusal([&] { kernels::Context(user.context, nullptr, user.queue); }), "the cl_device_id is null"));
  CHECK(contains(refusal([&] { kernels::Context(user.context, user.device, nullptr); }), "cl_command_queue is null"));
  CHECK(contains(refusal([&] { kernels::Context(user.context, user.device, other.queue); }),
                 "belongs to another cl_context: make one for the context"));
  const cl_command_queue unordered = user.new_queue(CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE);
  const std::string why = refusal([&] { kernels::Context(user.context, user.device, unordered); });
  CHECK(contains(why, "out of order"));
  CHECK(contains(why, "make one without CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE"));
  clReleaseCommandQueue(unordered);
  CHECK(contains(refusal([] { kernels::Context("no such device"); }), "no such device"));
}

TEST_CASE("wrong memory is refused, and the message names the argument") {
  const User user, other;
  kernels::Context context(user.context, user.device, user.queue), twin(user.context, user.device, user.queue);
  const cl_mem foreign = other.memory(64), small = user.memory(64);
  CHECK(contains(refusal([&] { context.wrap<uint32_t>(nullptr); }), "the cl_mem is null"));
  CHECK(contains(refusal([&] { context.wrap<uint32_t>(foreign); }), "belongs to another cl_context"));

  kernels::Sort sort(context, {.payload = kernels::Payload::words});
  const auto keys = context.wrap<uint32_t>(small), values = context.wrap<uint32_t>(small);
  CHECK(keys.size() == 16);
  CHECK(contains(refusal([&] { sort(keys, values, 17); }), "Sort: keys: the buffer has 64 bytes, 68 are needed"));
  CHECK(contains(refusal([&] { sort(keys, twin.wrap<uint32_t>(small), 16); }), "Sort: values: the buffer belongs to"));
  CHECK(contains(refusal([&] { sort(keys, {}, 16); }), "Sort: values: there is no buffer"));
  CHECK(contains(refusal([&] { keys.read(10, 7); }), "reading 7 elements from 10 on of a buffer of 16"));
  const std::vector<uint32_t> ten(10);
  CHECK(contains(refusal([&] { keys.write(ten, 7); }), "wrapped"));
  CHECK(contains(refusal([&] { context.buffer<uint64_t>(size_t{1} << 62); }), "more than"));
  try {
    context.buffer<unsigned char>(size_t{1} << 60);
    FAIL("so much memory was allocated");
  } catch (const kernels::Error& error) {
    CHECK(contains(error.what(), "take fewer elements at a time"));
    CHECK_FALSE(contains(error.what(), "trace."));  // no key of the program's configuration
  }
  clReleaseMemObject(foreign);
  clReleaseMemObject(small);
}

TEST_CASE("a part of the user's memory is sorted, and the rest stays") {
  const User user;
  cl_uint bits = 0;
  check_code(clGetDeviceInfo(user.device, CL_DEVICE_MEM_BASE_ADDR_ALIGN, sizeof bits, &bits, nullptr),
             "clGetDeviceInfo");
  const size_t first = bits / 8 / sizeof(uint32_t), count = 300;
  std::vector<uint32_t> keys = random_keys<uint32_t>(first + count + 50);
  const cl_mem memory = user.memory(keys);
  kernels::Context context(user.context, user.device, user.queue);
  const auto part = context.wrap<uint32_t>(memory, first, count);
  CHECK(part.size() == count);
  kernels::Sort sort(context, {});
  sort(part, count);
  std::sort(keys.begin() + first, keys.begin() + first + count);
  CHECK(user.read<uint32_t>(memory, keys.size()) == keys);
  CHECK(contains(refusal([&] { context.wrap<uint32_t>(memory, first, count + 51); }), "are no part of the cl_mem"));
  CHECK(contains(refusal([&] { context.wrap<uint32_t>(memory, 0, 0); }), "are no part of the cl_mem"));
  if (first > 1)
    CHECK(contains(refusal([&] { context.wrap<uint32_t>(memory, 1, 5); }), "the device needs multiples of"));
  clReleaseMemObject(memory);
}

TEST_CASE("a kernel that does not build is named, with OpenCL's code") {
  const TemporaryFolder folder;
  folder.write("scan.cl", "kernel void scan(global uint* counts) { counts[0] = no_such_name; }\n");
  const Environment own_kernels("WAVETRACER_KERNEL_DIR", folder.path().c_str());
  const User user;
  kernels::Context context(user.context, user.device, user.queue);
  const auto words = context.buffer<uint32_t>(8);
  try {
    kernels::Scan scan(context);
    scan(words, 8);
    FAIL("a kernel with an unknown name was launched");
  } catch (const kernels::Error& error) {
    CHECK(error.code() == CL_BUILD_PROGRAM_FAILURE);
    CHECK(error.kernel().starts_with("scan/scan"));
    CHECK(contains(error.what(), "no_such_name"));
  }
}
