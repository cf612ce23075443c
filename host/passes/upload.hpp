// SPDX-License-Identifier: Apache-2.0
// Uploads tables of a frame to buffers that later frames use again.
#pragma once
#include <cstring>
#include <utility>
#include <vector>

#include "gpu/gpu.hpp"

namespace wavetracer {

// Copies values to a buffer, which is made anew if it is too small for them.
template <class T>
void upload(gpu::Context& context, gpu::Buffer<T>& buffer, const std::vector<T>& values, const char* name) {
  if (buffer && values.size() <= buffer.size())
    buffer.write(values);
  else
    buffer = context.buffer(values, name);
}

// The same for tables that most frames do not change: a write that changes nothing still takes microseconds of a frame.
// last: the contents of the buffer, compared byte by byte. No copy of large tables is kept: they are uploaded each
// time, which takes no longer than the comparison.
template <class T>
void upload_changed(gpu::Context& context, gpu::Buffer<T>& buffer, std::vector<T>& last, std::vector<T> values,
                    const char* name) {
  constexpr size_t most_kept = size_t{1} << 26;
  const size_t bytes = values.size() * sizeof(T);
  if (buffer && values.size() == last.size() && (bytes == 0 || std::memcmp(values.data(), last.data(), bytes) == 0))
    return;
  upload(context, buffer, values, name);
  last = bytes <= most_kept ? std::move(values) : std::vector<T>();
}

}  // namespace wavetracer
