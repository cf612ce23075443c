// A program's source with one of its kernels: compilers of CPUs take some 0.3 s for each kernel, whether it is used or
// not.
#pragma once
#include <string>
#include <string_view>

namespace wavetracer::gpu {

// The source, expanded, with blanks instead of all kernels but the named one; its lines keep their numbers. Where the
// braces of a source do not match (branches of #if may each open one), all of it stays.
std::string with_one_kernel(std::string source, std::string_view kernel);

}  // namespace wavetracer::gpu
