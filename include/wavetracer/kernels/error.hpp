// SPDX-License-Identifier: Apache-2.0
// The exception of the kernel suite. Every public function of it throws this class or std::bad_alloc, and no other.
#pragma once
#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 300  // the newest, which <CL/cl.h> takes by itself, with a note on each compilation
#endif
#include <CL/cl.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace wavetracer::kernels {

// what() says what failed, on which device, and what to do about it.
class Error : public std::runtime_error {
 public:
  Error(const std::string& message, cl_int code, const std::string& kernel);
  Error(const Error&) noexcept;
  Error& operator=(const Error&) noexcept;
  ~Error() override;
  // The code that OpenCL returned, such as CL_MEM_OBJECT_ALLOCATION_FAILURE; 0 if no call of OpenCL failed, because the
  // suite itself refused an argument.
  cl_int code() const noexcept { return code_; }
  // "program/kernel" if a kernel could not be launched, such as "radix_sort/count"; else empty.
  const std::string& kernel() const noexcept { return *kernel_; }

 private:
  cl_int code_;
  std::shared_ptr<const std::string> kernel_;  // shared, so that a copy of an exception cannot throw
};

}  // namespace wavetracer::kernels
