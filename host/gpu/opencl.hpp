// The one place that includes OpenCL's C++ bindings, set up once: exceptions on, any OpenCL 1.2 platform or later.
// Included by this folder's .cpp files only; gpu.hpp, which everybody else includes, names nothing of OpenCL.
#pragma once
#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_MINIMUM_OPENCL_VERSION 110  // 120 leaves out what its own CommandQueue uses (CLHPP 2.0.16)
#define CL_HPP_TARGET_OPENCL_VERSION 300
#include <CL/opencl.hpp>
#include <string>

namespace wavetracer::gpu {

// "CL_OUT_OF_RESOURCES" for -5; an unknown code gives "OpenCL error -1234".
std::string error_name(cl_int code);
// The codes by which a device says that it has too little memory, some only at a buffer's first use.
bool is_out_of_memory(cl_int code);

}  // namespace wavetracer::gpu
