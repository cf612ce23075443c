// SPDX-License-Identifier: Apache-2.0
// Room for records that a device writes and the host reads in each frame.
#pragma once
#include "gpu/gpu.hpp"
#include "passes/advice.hpp"

namespace wavetracer {

// Makes room for `count` records, and a quarter more, where the buffer is smaller than that. Its contents are lost
// then. name: that of the records, for messages. Throws where the device has not enough memory.
template <class T>
void make_room(gpu::Context& context, gpu::Buffer<T>& buffer, size_t count, const char* name) {
  if (count > buffer.size()) buffer = context.buffer<T>(count + count / 4, {name, advice::links});
}

// Makes room for all records of the buffer on the host.
template <class T>
void make_host_room(gpu::Context& context, const gpu::Buffer<T>& buffer, gpu::HostMemory& host, const char* name) {
  if (host.bytes() < buffer.bytes()) host = context.host_memory(buffer.bytes(), name);
}

}  // namespace wavetracer
