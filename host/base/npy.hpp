// SPDX-License-Identifier: Apache-2.0
// The head of a NumPy array, format 1.0 (numpy.lib.format): the values follow it, in C order and little-endian.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace wavetracer {

// type: NumPy's word for the type of a value, such as "<f8". Returns a multiple of 64 bytes.
std::string npy_header(const std::string& type, const std::vector<size_t>& shape);

}  // namespace wavetracer
