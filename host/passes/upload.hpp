// Tables that most frames leave as they are: a write that changes nothing still takes microseconds of a frame.
#pragma once
#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "gpu/gpu.hpp"

namespace wavetracer {

// Values to a buffer, which is made anew where it is too small for them. last: what it has, compared byte by byte.
template <class T>
void upload(gpu::Context& context, gpu::Buffer<T>& buffer, std::vector<T>& last, std::vector<T> values,
            const char* name) {
  const size_t bytes = values.size() * sizeof(T);
  if (buffer && values.size() == last.size() && (bytes == 0 || std::memcmp(values.data(), last.data(), bytes) == 0))
    return;
  if (buffer && values.size() <= buffer.size())
    buffer.write(values);
  else
    buffer = context.buffer(values, name);
  last = std::move(values);
}

}  // namespace wavetracer
