// SPDX-License-Identifier: Apache-2.0
// Tests that calls only enqueue, start after the user's events, and give an event of their end.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "contains.hpp"
#include "gpu/temporary.hpp"
#include "kernel_suite/user.hpp"
#include "wavetracer/kernels/kernels.hpp"

using namespace wavetracer::test;
namespace kernels = wavetracer::kernels;

namespace {

cl_int status_of(cl_event event) {
  cl_int status = CL_QUEUED;
  check_code(clGetEventInfo(event, CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof status, &status, nullptr),
             "clGetEventInfo");
  return status;
}

cl_event gate_of(const User& user) {
  cl_int code = CL_SUCCESS;
  const cl_event gate = clCreateUserEvent(user.context, &code);
  check_code(code, "clCreateUserEvent");
  return gate;
}

}  // namespace

TEST_CASE("a sort waits for the user's event, and its own event comes after it") {
  const User user;
  std::vector<uint32_t> keys = random_keys<uint32_t>(20000);
  const cl_mem memory = user.memory(keys);
  kernels::Context context(user.context, user.device, user.queue);
  const auto wrapped = context.wrap<uint32_t>(memory);
  kernels::Sort sort(context, {.method = kernels::SortMethod::radix});
  sort.reserve(keys.size());
  const cl_event gate = gate_of(user);
  cl_event done = nullptr;
  sort(wrapped, keys.size(), {}, {.after = {&gate, 1}, .done = &done});
  REQUIRE(done != nullptr);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  CHECK(status_of(done) > CL_COMPLETE);
  // Another queue of the user's is not behind the gate: the keys are as they were.
  const cl_command_queue other = user.new_queue();
  CHECK(user.read<uint32_t>(memory, keys.size(), other) == keys);
  check_code(clSetUserEventStatus(gate, CL_COMPLETE), "clSetUserEventStatus");
  check_code(clWaitForEvents(1, &done), "clWaitForEvents");
  CHECK(status_of(done) == CL_COMPLETE);
  std::sort(keys.begin(), keys.end());
  CHECK(user.read<uint32_t>(memory, keys.size(), other) == keys);
  clReleaseEvent(gate);
  clReleaseEvent(done);
  clReleaseCommandQueue(other);
  clReleaseMemObject(memory);
}

TEST_CASE("queues of one context are ordered by events") {
  const User user;
  const cl_command_queue second = user.new_queue();
  kernels::Context first_context(user.context, user.device, user.queue);
  kernels::Context second_context(user.context, user.device, second);
  const std::vector<uint32_t> ones(3000, 1);
  const cl_mem memory = user.memory(ones);
  kernels::Scan scan(first_context);
  kernels::Sort sort(second_context, {.method = kernels::SortMethod::radix});
  const cl_event gate = gate_of(user);
  cl_event scanned = nullptr, sorted = nullptr;
  scan(first_context.wrap<uint32_t>(memory), ones.size(), {.after = {&gate, 1}, .done = &scanned});
  sort(second_context.wrap<uint32_t>(memory), ones.size(), {}, {.after = {&scanned, 1}, .done = &sorted});
  CHECK(status_of(sorted) > CL_COMPLETE);
  check_code(clSetUserEventStatus(gate, CL_COMPLETE), "clSetUserEventStatus");
  check_code(clWaitForEvents(1, &sorted), "clWaitForEvents");
  std::vector<uint32_t> expected(ones.size());
  for (uint32_t i = 0; i < expected.size(); ++i) expected[i] = i;
  CHECK(user.read<uint32_t>(memory, expected.size(), second) == expected);
  for (const cl_event event : {gate, scanned, sorted}) clReleaseEvent(event);
  clReleaseCommandQueue(second);
  clReleaseMemObject(memory);
}

TEST_CASE("an event of another context is refused with OpenCL's code, and nothing is sorted") {
  const User user, other;
  const std::vector<uint32_t> keys = random_keys<uint32_t>(50);
  kernels::Context context(user.context, user.device, user.queue);
  const auto buffer = context.buffer<uint32_t>(keys.size());
  buffer.write(keys);
  kernels::Sort sort(context, {});
  const cl_event gate = gate_of(other), none = nullptr;
  cl_event done = nullptr;
  try {
    sort(buffer, keys.size(), {}, {.after = {&gate, 1}, .done = &done});
    FAIL("an event of another context was taken");
  } catch (const kernels::Error& error) {
    CHECK(error.code() == CL_INVALID_CONTEXT);
    CHECK(contains(error.what(), "waiting for 1 events that were given"));
  }
  CHECK(contains(message_of<kernels::Error>([&] {
                   sort(buffer, keys.size(), {}, {.after = {&none, 1}});
                 }),
                 "the cl_event is null"));
  CHECK(done == nullptr);
  CHECK(buffer.read() == keys);
  // NVIDIA's driver (580.159) waits for ever where a context is released with a user event that was never set.
  check_code(clSetUserEventStatus(gate, CL_COMPLETE), "clSetUserEventStatus");
  clReleaseEvent(gate);
}

TEST_CASE("a queue with profiling is used as it is, and one without has none") {
  const User user(CL_QUEUE_PROFILING_ENABLE);
  kernels::Context context(user.context, user.device, user.queue);
  const auto words = context.buffer<uint32_t>(1000);
  words.write(std::vector<uint32_t>(1000, 3));
  kernels::Scan scan(context);
  cl_event done = nullptr;
  scan(words, 1000, {.done = &done});
  check_code(clWaitForEvents(1, &done), "clWaitForEvents");
  cl_ulong end = 0;
  CHECK(clGetEventProfilingInfo(done, CL_PROFILING_COMMAND_END, sizeof end, &end, nullptr) == CL_SUCCESS);
  clReleaseEvent(done);
  CHECK(words.read(999, 1) == std::vector<uint32_t>{2997});
}
