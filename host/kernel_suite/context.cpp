// SPDX-License-Identifier: Apache-2.0
// The public context and its memory, over those of host/gpu.
// Sizes are checked here, since passes count in elements and users may give any.
#include "wavetracer/kernels/context.hpp"

#include <fmt/format.h>

#include <limits>

#include "kernel_suite/state.hpp"

namespace wavetracer::kernels {

namespace {

constexpr gpu::Needs needs_nothing{.fp64 = false, .int64_atomics = false};
constexpr const char* memory_advice =
    "Free memory of the device, take fewer elements at a time, or choose a device with more memory";

gpu::Context& gpu_of(const std::shared_ptr<Context::State>& state) {
  if (!state) refuse("Context", "it was moved from");
  return state->gpu;
}

// Returns the bytes of `count` elements.
size_t bytes_of(size_t count, size_t element_bytes) {
  if (count > std::numeric_limits<size_t>::max() / element_bytes)
    refuse("Buffer", fmt::format("{} elements of {} bytes are more than any memory", count, element_bytes));
  return count * element_bytes;
}

}  // namespace

Context::State::State(const gpu::Handles& handles) : gpu(handles, needs_nothing) {
  gpu.set_memory_advice(memory_advice);
}

Context::State::State(std::string_view device) : gpu(device, needs_nothing) {
  gpu.set_memory_advice(memory_advice);
  gpu.set_profiling(false);
}

Context::Context(cl_context context, cl_device_id device, cl_command_queue queue)
    : state_(with_errors([&] {
        return std::make_shared<State>(gpu::Handles{context, device, queue});
      })) {}
Context::Context(std::string_view device) : state_(with_errors([&] { return std::make_shared<State>(device); })) {}
Context::~Context() = default;
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;

cl_context Context::context() const { return static_cast<cl_context>(gpu_of(state_).handles().context); }
cl_device_id Context::device() const { return static_cast<cl_device_id>(gpu_of(state_).handles().device); }
cl_command_queue Context::queue() const { return static_cast<cl_command_queue>(gpu_of(state_).handles().queue); }
const std::string& Context::name() const { return gpu_of(state_).info().name; }

void Context::finish() const {
  with_errors([&] { gpu_of(state_).finish(); });
}

Memory Context::wrap_bytes(cl_mem memory) const {
  return with_errors([&] {
    Memory out;
    out.state_ = std::make_shared<const Memory::State>(Memory::State{state_, gpu_of(state_).wrap(memory, "wrapped")});
    return out;
  });
}

Memory Context::wrap_range(cl_mem memory, size_t first, size_t count, size_t element_bytes) const {
  return with_errors([&] {
    Memory out;
    out.state_ = std::make_shared<const Memory::State>(Memory::State{
        state_,
        gpu_of(state_).wrap(memory, bytes_of(first, element_bytes), bytes_of(count, element_bytes), "wrapped")});
    return out;
  });
}

Memory Context::allocate(size_t count, size_t element_bytes) const {
  return with_errors([&] {
    Memory out;
    out.state_ = std::make_shared<const Memory::State>(Memory::State{
        state_, gpu_of(state_).buffer<unsigned char>(bytes_of(count, element_bytes), {"allocated", memory_advice})});
    return out;
  });
}

Memory::Memory() = default;
Memory::~Memory() = default;
Memory::Memory(const Memory&) = default;
Memory::Memory(Memory&&) noexcept = default;
Memory& Memory::operator=(const Memory&) = default;
Memory& Memory::operator=(Memory&&) noexcept = default;

size_t Memory::bytes() const { return state_ ? state_->memory.bytes() : 0; }
cl_mem Memory::handle() const { return state_ ? static_cast<cl_mem>(state_->memory.handle()) : nullptr; }

void Memory::write_bytes(const void* from, size_t offset, size_t bytes, const Call& call) const {
  if (!state_) refuse("Buffer", "writing a buffer that was never made");
  with_errors([&] {
    gpu::Context& context = state_->context->gpu;
    begin(context, call);
    gpu::Buffer<unsigned char>(state_->memory).write({static_cast<const unsigned char*>(from), bytes}, offset);
    end(context, call);
  });
}

void Memory::read_bytes(void* to, size_t offset, size_t bytes, const Call& call) const {
  if (!state_) {
    if (bytes == 0) return;
    refuse("Buffer", "reading a buffer that was never made");
  }
  with_errors([&] {
    gpu::Context& context = state_->context->gpu;
    begin(context, call);
    gpu::Buffer<unsigned char>(state_->memory).read_into({static_cast<unsigned char*>(to), bytes}, offset);
    end(context, call);
  });
}

void Memory::refuse_range(size_t first, size_t count, size_t size) {
  refuse("Buffer", fmt::format("reading {} elements from {} on of a buffer of {}", count, first, size));
}

}  // namespace wavetracer::kernels
