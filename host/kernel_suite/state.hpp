// SPDX-License-Identifier: Apache-2.0
// The private halves of Context and Memory, and what every function of the suite begins with: arguments are taken over
// from public types, exceptions become the public one, and events frame the commands. A face of a pass adds nothing
// else to it.
#pragma once
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "gpu/gpu.hpp"
#include "wavetracer/kernels/context.hpp"

namespace wavetracer::kernels {

// Passes and memory share it, so that they may outlive their Context.
struct Context::State {
  explicit State(const gpu::Handles& handles);
  explicit State(std::string_view device);
  gpu::Context gpu;
};

struct Memory::State {
  std::shared_ptr<Context::State> context;  // destroyed after the memory
  gpu::Memory memory;
};

// The state of a pass derives from it: the context is destroyed after the pass.
struct PassState {
  explicit PassState(const Context& of);
  std::shared_ptr<Context::State> context;
};

// Throws Error about an argument. pass: the public class, such as "Sort".
[[noreturn]] void refuse(const char* pass, const std::string& message);
// Throws the exception that is being handled as Error.
[[noreturn]] void rethrow_as_error();

// Runs a function, whose exceptions become Error.
template <class Function>
decltype(auto) with_errors(const Function& function) {
  try {
    return function();
  } catch (...) {
    rethrow_as_error();
  }
}

// Throws Error if the device lacks what a pass needs. Constructors of passes call it first, unless they need neither.
void require_device(const Context& context, const char* pass, const gpu::Needs& needs);

// A public buffer as that of a pass. Throws Error that names the argument if there is no buffer, if it belongs to
// another context, or if it has less than `least` elements.
gpu::Memory memory_of(const PassState& state, const char* pass, const char* argument, const Memory& memory,
                      size_t least_bytes);
template <class T>
gpu::Buffer<T> buffer_of(const PassState& state, const char* pass, const char* argument, const Buffer<T>& buffer,
                         size_t least) {
  return gpu::Buffer<T>(memory_of(state, pass, argument, buffer, least * sizeof(T)));
}

// A number of elements as passes take it. Throws Error above 2^32 - 1.
uint32_t count_of(const char* pass, size_t n);

// Events before and after: after the events of the call come the commands that `enqueue` enqueues, then *done.
void begin(gpu::Context& context, const Call& call);
void end(gpu::Context& context, const Call& call);
template <class Enqueue>
void enqueue(const PassState& state, const Call& call, const Enqueue& commands) {
  with_errors([&] {
    begin(state.context->gpu, call);
    commands();
    end(state.context->gpu, call);
  });
}

}  // namespace wavetracer::kernels
