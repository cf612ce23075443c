// SPDX-License-Identifier: Apache-2.0
// Room for records that a device writes and the host reads in each frame.
#pragma once
#include "gpu/gpu.hpp"
#include "passes/advice.hpp"

namespace wavetracer {

// Makes room for `count` records in both, and a quarter more, where the buffer is smaller than that. Their contents are
// lost then. name: that of the records, for messages. Throws where the device has not enough memory.
template <class T>
void make_room(gpu::Context& context, gpu::Buffer<T>& buffer, gpu::HostMemory& host, size_t count, const char* name) {
  if (count <= buffer.size()) return;
  const size_t larger = count + count / 4;
  host = context.host_memory(larger * sizeof(T), name);
  buffer = context.buffer<T>(larger, {name, advice::links});  // last, since its size is the room that there is
}

}  // namespace wavetracer
