// SPDX-License-Identifier: Apache-2.0
// Checks of arguments, and exceptions that become the public one.
// A pass throws std::invalid_argument or std::logic_error where a caller is wrong, and gpu::CallError where OpenCL is.
#include "kernel_suite/state.hpp"

#include <fmt/format.h>

#include <limits>
#include <new>
#include <vector>

namespace wavetracer::kernels {

Error::Error(const std::string& message, cl_int code, const std::string& kernel)
    : std::runtime_error(message), code_(code), kernel_(std::make_shared<const std::string>(kernel)) {}
Error::Error(const Error&) noexcept = default;
Error& Error::operator=(const Error&) noexcept = default;
Error::~Error() = default;

void refuse(const char* pass, const std::string& message) { throw Error(fmt::format("{}: {}", pass, message), 0, ""); }

void rethrow_as_error() {
  try {
    throw;
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const gpu::CallError& error) {
    throw Error(error.what(), error.opencl_code(), error.failed_kernel());
  } catch (const std::exception& error) {
    throw Error(error.what(), 0, "");
  }
}

PassState::PassState(const Context& of) : context(of.state()) {
  if (!context) refuse("Context", "it was moved from");
}

void require_device(const Context& context, const char* pass, const gpu::Needs& needs) {
  const gpu::DeviceInfo& device = PassState(context).context->gpu.info();
  if (const std::string lacking = gpu::lacks(device, needs); !lacking.empty())
    refuse(pass, fmt::format("{} ({}) lacks {}; choose another device", device.name, device.platform, lacking));
}

gpu::Memory memory_of(const PassState& state, const char* pass, const char* argument, const Memory& memory,
                      size_t least_bytes) {
  if (!memory) refuse(pass, fmt::format("{}: there is no buffer: make it by wrap() or buffer()", argument));
  if (memory.state()->context != state.context)
    refuse(pass, fmt::format("{}: the buffer belongs to another Context: make it by the one of the pass", argument));
  if (memory.bytes() < least_bytes)
    refuse(pass, fmt::format("{}: the buffer has {} bytes, {} are needed", argument, memory.bytes(), least_bytes));
  return memory.state()->memory;
}

uint32_t count_of(const char* pass, size_t n) {
  constexpr size_t most = std::numeric_limits<uint32_t>::max();
  if (n > most) refuse(pass, fmt::format("{} elements: at most {} at a time", n, most));
  return static_cast<uint32_t>(n);
}

void begin(gpu::Context& context, const Call& call) {
  context.wait_for(std::vector<void*>(call.after.begin(), call.after.end()));
}

void end(gpu::Context& context, const Call& call) {
  if (!call.done) return;
  *call.done = static_cast<cl_event>(context.mark().retained_event());
  context.flush();
}

}  // namespace wavetracer::kernels
