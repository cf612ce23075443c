// SPDX-License-Identifier: Apache-2.0
// Tests that two contexts work in two threads at once, on queues of one cl_context and on those of two.
#include <doctest/doctest.h>

#include <algorithm>
#include <thread>

#include "kernel_suite/user.hpp"
#include "wavetracer/kernels/kernels.hpp"

using namespace wavetracer::test;
namespace kernels = wavetracer::kernels;

namespace {

// Sorts and scans again and again, and counts wrong results.
void work(const User& user, cl_command_queue queue, uint64_t seed, size_t& faults) {
  try {
    const kernels::Context context(user.context, user.device, queue);
    kernels::Sort sort(context, {.payload = kernels::Payload::index});
    kernels::Scan scan(context);
    for (uint64_t round = 0; round < 10; ++round) {
      std::vector<uint32_t> keys = random_keys<uint32_t>(10000 + 100 * round, seed + round);
      const auto buffer = context.buffer<uint32_t>(keys.size()), order = context.buffer<uint32_t>(keys.size());
      buffer.write(keys);
      sort(buffer, order, keys.size());
      std::vector<uint32_t> sorted = keys;
      std::sort(sorted.begin(), sorted.end());
      faults += buffer.read() != sorted;
      const std::vector<uint32_t> places = order.read();
      for (size_t i = 0; i < places.size(); ++i) faults += keys[places[i]] != sorted[i];
      order.write(std::vector<uint32_t>(keys.size(), 1));
      scan(order, keys.size());
      faults += order.read(keys.size() - 1, 1) != std::vector<uint32_t>{static_cast<uint32_t>(keys.size() - 1)};
    }
  } catch (const std::exception&) {
    faults += 1000;
  }
}

}  // namespace

TEST_CASE("two contexts work in two threads, on queues of one cl_context") {
  const User user;
  const cl_command_queue second = user.new_queue();
  size_t faults[2] = {};
  std::thread one(work, std::cref(user), user.queue, 1, std::ref(faults[0]));
  std::thread two(work, std::cref(user), second, 100, std::ref(faults[1]));
  one.join();
  two.join();
  CHECK(faults[0] == 0);
  CHECK(faults[1] == 0);
  clReleaseCommandQueue(second);
}

TEST_CASE("two contexts work in two threads, on two cl_contexts") {
  const User users[2];
  size_t faults[2] = {};
  std::thread one(work, std::cref(users[0]), users[0].queue, 1, std::ref(faults[0]));
  std::thread two(work, std::cref(users[1]), users[1].queue, 100, std::ref(faults[1]));
  one.join();
  two.join();
  CHECK(faults[0] == 0);
  CHECK(faults[1] == 0);
}
