// SPDX-License-Identifier: Apache-2.0
// The memory of columns that is used from frame to frame.
#pragma once
#include <cstddef>
#include <vector>

namespace wavetracer {

// Gives a column `count` values, whatever they are: its memory is kept where it is large enough. Else it gets new
// memory without a copy, and some to spare if it had any before, since numbers of paths change from frame to frame.
template <class T>
void size_column(std::vector<T>& column, size_t count) {
  if (count > column.capacity()) {
    const size_t spare = column.capacity() > 1 ? count / 8 : 0;
    column = std::vector<T>();
    column.reserve(count + spare);
  }
  column.resize(count);
}

}  // namespace wavetracer
