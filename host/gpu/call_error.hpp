// SPDX-License-Identifier: Apache-2.0
// Errors of the device layer.
#pragma once
#include <string>

#include "wavetracer/error.hpp"

namespace wavetracer::gpu {

// A call of OpenCL failed, or a handle that was given is refused.
class CallError : public DeviceError {
 public:
  explicit CallError(const std::string& message, int opencl_code = 0, const std::string& kernel = {})
      : DeviceError(message), opencl_code_(opencl_code), kernel_(kernel) {}
  // The code that OpenCL returned; 0 if none of its calls failed.
  int opencl_code() const noexcept { return opencl_code_; }
  // "program/kernel" if a kernel was being built or launched; else empty.
  const std::string& failed_kernel() const noexcept { return kernel_; }

 private:
  int opencl_code_;
  std::string kernel_;
};

// A buffer is larger than the device allows, or than its free memory.
class BufferError : public CallError {
 public:
  using CallError::CallError;
};

}  // namespace wavetracer::gpu
