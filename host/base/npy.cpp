// SPDX-License-Identifier: Apache-2.0
// The head is padded with blanks to a multiple of 64 bytes, so that values are aligned.
#include "base/npy.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace wavetracer {

std::string npy_header(const std::string& type, const std::vector<size_t>& shape) {
  constexpr size_t alignment = 64, preamble = 10, byte = 256;
  const std::string dimensions =
      shape.size() == 1 ? fmt::format("({},)", shape[0]) : fmt::format("({})", fmt::join(shape, ", "));
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, dimensions);
  text.resize((preamble + text.size() + 1 + alignment - 1) / alignment * alignment - preamble, ' ');
  text.back() = '\n';
  std::string out("\x93NUMPY\x01\x00", 8);
  out += static_cast<char>(text.size() % byte);
  out += static_cast<char>(text.size() / byte);
  return out + text;
}

}  // namespace wavetracer
