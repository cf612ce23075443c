// SPDX-License-Identifier: Apache-2.0
// Reduces a program's source to one of its kernels: compilers of CPUs take some 0.3 s for each kernel, even an unused
// one.
#pragma once
#include <string>
#include <string_view>

namespace wavetracer::gpu {

// Returns the expanded source with blanks instead of all kernels but the named one; lines keep their numbers. If the
// braces of a source do not match (branches of #if may each open one), nothing is removed.
std::string with_one_kernel(std::string source, std::string_view kernel);

}  // namespace wavetracer::gpu
