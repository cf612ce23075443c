// SPDX-License-Identifier: Apache-2.0
// The one place that launches: arguments are checked against the kernel's, sizes padded, failures named.
// A wrong argument is a fault of the calling code (std::logic_error); a refused launch is a fault of the device
// (DeviceError).
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdexcept>
#include "gpu/state.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::gpu {

std::string Kernel::State::describe(unsigned index) const {
  const std::string declared =
      index < arguments.size() ? fmt::format(" ({} {})", arguments[index].type, arguments[index].name) : "";
  return fmt::format("argument {}{} of kernel {}", index, declared, name);
}

const std::string& Kernel::name() const {
  static const std::string none;
  return state_ ? state_->name : none;
}

void Kernel::check_count(size_t count) const {
  if (!state_) throw std::logic_error("launching a kernel that was never made");
  state_->make();
  if (count != state_->argument_count) {
    throw std::logic_error(
        fmt::format("kernel {} takes {} arguments, {} were given", state_->name, state_->argument_count, count));
  }
}

void Kernel::check_name(unsigned index, const char* name) const {
  const State& s = *state_;
  if (index >= s.arguments.size() || s.arguments[index].name.empty() || s.arguments[index].name == name) return;
  throw std::logic_error(
      fmt::format("{} is `{}` in the kernel that the program was built with; build it again", s.describe(index), name));
}

void Kernel::set_value(unsigned index, const void* value, size_t bytes) {
  State& s = *state_;
  if (index < s.arguments.size()) {
    const Argument& wanted = s.arguments[index];
    if (wanted.kind != Argument::Kind::value) {
      throw std::logic_error(fmt::format("{} is {} memory, a plain value was given", s.describe(index),
                                         wanted.kind == Argument::Kind::local ? "local" : "global"));
    }
    if (wanted.bytes != 0 && wanted.bytes != bytes) {
      throw std::logic_error(
          fmt::format("{} has {} bytes, a value of {} was given", s.describe(index), wanted.bytes, bytes));
    }
  }
  const cl_int code = clSetKernelArg(s.kernel(), index, bytes, value);
  if (code == CL_SUCCESS) return;
  throw std::logic_error(fmt::format("{} refuses a value of {} bytes: {}", s.describe(index), bytes, error_name(code)));
}

void Kernel::set_memory(unsigned index, const Memory* memory) {
  State& s = *state_;
  if (memory && !*memory)
    throw std::logic_error(fmt::format("{} is a buffer that was never allocated", s.describe(index)));
  if (memory && memory->context_->state_.get() != s.context) {
    throw std::logic_error(fmt::format("{} is a buffer of another context", s.describe(index)));
  }
  if (index < s.arguments.size() && s.arguments[index].kind != Argument::Kind::memory) {
    throw std::logic_error(fmt::format("{} is no global memory, a buffer was given", s.describe(index)));
  }
  const cl_mem handle = memory ? static_cast<cl_mem>(memory->handle_.get()) : nullptr;
  const cl_int code = clSetKernelArg(s.kernel(), index, sizeof handle, &handle);
  if (code == CL_SUCCESS) return;
  throw std::logic_error(fmt::format("{} refuses a buffer: {}", s.describe(index), error_name(code)));
}

void Kernel::enqueue(Range range, Stage stage) {
  State& s = *state_;
  std::array<size_t, 3> padded;
  for (unsigned d = 0; d < 3; ++d) {
    if (range.local[d] == 0) throw std::logic_error(fmt::format("kernel {} was given work-groups of no items", s.name));
    padded[d] = (range.global[d] + range.local[d] - 1) / range.local[d] * range.local[d];
  }
  cl::Event event;
  s.context->locked = true;  // it stays locked if this throws: PoCL compiles for the size of groups
  const cl_int code = clEnqueueNDRangeKernel(s.context->queue(), s.kernel(), range.dimensions, nullptr, padded.data(),
                                             range.local.data(), 0, nullptr, s.context->event_of(event));
  s.context->locked = false;
  if (code != CL_SUCCESS) {
    s.context->fail(
        code,
        fmt::format("launching kernel {} over {} items in groups of {} (the device allows {})", s.name,
                    fmt::join(padded, " x "), fmt::join(range.local, " x "), s.context->info.max_work_group),
        s.profile_name);
  }
  if (!s.context->profile.on) return;
  KernelTime& time = s.context->profile.kernel(s.profile_name);
  time.launches++;
  time.items += uint64_t{range.global[0]} * range.global[1] * range.global[2];
  s.context->profile.add(stage, std::move(event), &time);
}

}  // namespace wavetracer::gpu
