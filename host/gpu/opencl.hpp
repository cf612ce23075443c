// SPDX-License-Identifier: Apache-2.0
// The one place that includes OpenCL's C++ bindings, configured once: exceptions on, any OpenCL 1.2 platform or later.
// Only this folder's .cpp files include it; gpu.hpp, which all others include, names nothing of OpenCL.
#pragma once
#define CL_HPP_ENABLE_EXCEPTIONS
// With 120, the bindings leave out what their own CommandQueue uses (CLHPP 2.0.16).
#define CL_HPP_MINIMUM_OPENCL_VERSION 110
#define CL_HPP_TARGET_OPENCL_VERSION 300
#include <CL/opencl.hpp>
#include <string>

namespace wavetracer::gpu {

// Returns "CL_OUT_OF_RESOURCES" for -5; for an unknown code "OpenCL error -1234".
std::string error_name(cl_int code);
// Tells whether the code means that the device has too little memory; some codes come only at a buffer's first use.
bool is_out_of_memory(cl_int code);

}  // namespace wavetracer::gpu
