// SPDX-License-Identifier: Apache-2.0
// Contexts, queues, memory and events of somebody else. All of them are retained, checked where OpenCL can be asked,
// and never changed.
#include <fmt/format.h>
#include <algorithm>
#include <limits>
#include <vector>
#include "gpu/device.hpp"
#include "gpu/state.hpp"

namespace wavetracer::gpu {

namespace {

void refuse_null(const void* handle, const char* type) {
  if (!handle) throw CallError(fmt::format("the {} is null: give one that OpenCL has made", type));
}

void check_queue(const cl::CommandQueue& queue, const cl::Context& context, const cl::Device& device,
                 const std::string& name) {
  if (queue.getInfo<CL_QUEUE_CONTEXT>()() != context())
    throw CallError(name + ": the cl_command_queue belongs to another cl_context: make one for the context given");
  if (queue.getInfo<CL_QUEUE_DEVICE>()() != device())
    throw CallError(name + ": the cl_command_queue belongs to another cl_device_id: give the device of the queue");
  if (queue.getInfo<CL_QUEUE_PROPERTIES>() & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE)
    throw CallError(name +
                    ": the cl_command_queue is out of order, and passes of several launches rely on the order: make "
                    "one without CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE, and order it with others by events");
}

}  // namespace

Context::Context(const Handles& handles, const Needs& needs) : state_(std::make_unique<State>()) {
  refuse_null(handles.context, "cl_context");
  refuse_null(handles.device, "cl_device_id");
  refuse_null(handles.queue, "cl_command_queue");
  State& s = *state_;
  s.foreign = true;
  s.profile.on = false;
  try {
    s.device = cl::Device(static_cast<cl_device_id>(handles.device), true);
    s.info = describe(std::numeric_limits<size_t>::max(), s.device);
    s.context = cl::Context(static_cast<cl_context>(handles.context), true);
    s.queue = s.plain = cl::CommandQueue(static_cast<cl_command_queue>(handles.queue), true);
    check_queue(s.queue, s.context, s.device, s.info.name);
    if (s.queue.getInfo<CL_QUEUE_PROPERTIES>() & CL_QUEUE_PROFILING_ENABLE) s.timed = s.queue;
    s.device_options = device_options(s.device, s.info);
  } catch (const cl::Error& error) {
    s.fail(error.err(), fmt::format("reading the context, device and queue that were given ({})", error.what()));
  }
  if (const std::string lacking = lacks(s.info, needs); !lacking.empty())
    throw CallError(fmt::format("{} ({}) lacks {}; give another device", s.info.name, s.info.platform, lacking));
}

Memory Context::wrap(void* memory, const BufferName& name) {
  refuse_null(memory, "cl_mem");
  State& s = *state_;
  try {
    cl::Buffer buffer(static_cast<cl_mem>(memory), true);
    if (buffer.getInfo<CL_MEM_TYPE>() != CL_MEM_OBJECT_BUFFER)
      throw CallError(fmt::format("{}: the cl_mem \"{}\" is no buffer: images and pipes cannot be wrapped", s.info.name,
                                  name.name));
    if (buffer.getInfo<CL_MEM_CONTEXT>()() != s.context())
      throw CallError(
          fmt::format("{}: the cl_mem \"{}\" belongs to another cl_context: make it with the context of the queue",
                      s.info.name, name.name));
    const size_t bytes = buffer.getInfo<CL_MEM_SIZE>();
    const cl_mem handle = buffer();
    buffer() = nullptr;  // adopt() takes over what was retained
    return adopt(handle, bytes, name.name);
  } catch (const cl::Error& error) {
    s.fail(error.err(), fmt::format("reading the cl_mem \"{}\" that was given ({})", name.name, error.what()));
  }
}

Memory Context::wrap(void* memory, size_t offset, size_t bytes, const BufferName& name) {
  const Memory whole = wrap(memory, name);
  const State& s = *state_;
  if (bytes == 0 || offset > whole.bytes() || bytes > whole.bytes() - offset)
    throw CallError(fmt::format("{}: {} bytes at {} are no part of the cl_mem \"{}\" of {} bytes", s.info.name, bytes,
                                offset, name.name, whole.bytes()));
  const size_t alignment = std::max(1u, s.device.getInfo<CL_DEVICE_MEM_BASE_ADDR_ALIGN>() / 8);
  if (offset % alignment != 0)
    throw CallError(fmt::format("{}: a part of the cl_mem \"{}\" begins at byte {}: the device needs multiples of {}",
                                s.info.name, name.name, offset, alignment));
  const cl_buffer_region region{offset, bytes};
  cl_int code = CL_SUCCESS;
  const cl_mem part = clCreateSubBuffer(static_cast<cl_mem>(memory), 0, CL_BUFFER_CREATE_TYPE_REGION, &region, &code);
  if (code != CL_SUCCESS) s.fail(code, fmt::format("making a part of the cl_mem \"{}\"", name.name));
  return adopt(part, bytes, name.name);
}

void Context::wait_for(std::span<void* const> events) {
  if (events.empty()) return;
  std::vector<cl_event> list;
  for (void* const event : events) {
    refuse_null(event, "cl_event");
    list.push_back(static_cast<cl_event>(event));
  }
  const cl_int code =
      clEnqueueBarrierWithWaitList(state_->queue(), static_cast<cl_uint>(list.size()), list.data(), nullptr);
  if (code != CL_SUCCESS) state_->fail(code, fmt::format("waiting for {} events that were given", list.size()));
}

}  // namespace wavetracer::gpu
