// SPDX-License-Identifier: Apache-2.0
// Context: a device opened with one in-order profiling queue; foreign.cpp makes one of other handles.
// By default it requires double precision and 64-bit atomics, without which paths cannot be solved or sequences kept;
// Needs can drop these requirements.
#include <fmt/format.h>
#include <map>
#include <mutex>
#include "gpu/device.hpp"
#include "gpu/pocl.hpp"
#include "gpu/state.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::gpu {
namespace {

// OpenCL's contexts, one per device, which all Contexts of the process share: NVIDIA takes 0.2 s to open one. They are
// never destroyed, because a driver may be gone when a static object is destroyed.
class OpenContexts {
 public:
  static OpenContexts& of_process() {
    static auto* const contexts = new OpenContexts;
    return *contexts;
  }
  cl::Context open(const cl::Device& device) {
    const std::lock_guard lock(mutex_);
    const auto found = contexts_.find(device());
    return found != contexts_.end() ? found->second : contexts_[device()] = cl::Context(device);
  }
  // Forgets a context that a crashed kernel or a throwing compiler has spoilt: the next open of the device makes
  // another one.
  void forget(const cl::Device& device) {
    const std::lock_guard lock(mutex_);
    contexts_.erase(device());
  }

 private:
  std::mutex mutex_;
  std::map<cl_device_id, cl::Context> contexts_;
};

}  // namespace

Context::Context(std::string_view device_text, const Needs& needs) : state_(std::make_unique<State>()) {
  State& s = *state_;
  const std::vector<DeviceInfo> devices = list_devices();
  s.info = devices[choose_device(devices, device_text)];
  if (const std::string lacking = lacks(s.info, needs); !lacking.empty()) {
    throw DeviceError(fmt::format("{} ({}) lacks {}; choose another device (`wavetracer devices` lists them)",
                                  s.info.name, s.info.platform, lacking));
  }
  try {
    s.device = all_devices().at(s.info.index);
    s.context = OpenContexts::of_process().open(s.device);
    s.queue = s.timed = cl::CommandQueue(s.context, s.device, CL_QUEUE_PROFILING_ENABLE);
    s.device_options = device_options(s.device, s.info);
  } catch (const cl::Error& error) {
    s.fail(error.err(), fmt::format("opening the device ({})", error.what()));
  }
}

Context::~Context() {
  const State& s = *state_;
  if (s.locked) {
    if (!s.foreign) OpenContexts::of_process().forget(s.device);
    static_cast<void>(state_.release());
    return;
  }
  try {
    if (s.queue() && (!s.foreign || s.staged.any())) s.queue.finish();
  } catch (const cl::Error&) {
    // A failed command was reported, or does not matter any more.
  }
}

const DeviceInfo& Context::info() const { return state_->info; }

std::vector<std::string> Context::notes() const {
  std::vector<std::string> out;
  for (const std::string& note : {pocl_cache_note(), state_->cache_note})
    if (!note.empty()) out.push_back(note);
  return out;
}

double Context::build_seconds() const { return state_->build_seconds; }

size_t Context::builds_from_source() const { return state_->builds_from_source; }

void Context::finish() {
  try {
    state_->queue.finish();
    state_->staged.done();
  } catch (const cl::Error& error) {
    state_->fail(error.err(), "finishing the queue");
  }
}

Marker Context::mark() {
  cl_event event = nullptr;
  const cl_int code = clEnqueueMarkerWithWaitList(state_->queue(), 0, nullptr, &event);
  if (code != CL_SUCCESS) state_->fail(code, "marking a place in the queue");
  Marker out;
  out.event_ = std::shared_ptr<void>(event, [](void* done) { clReleaseEvent(static_cast<cl_event>(done)); });
  return out;
}

void* Marker::retained_event() const {
  clRetainEvent(static_cast<cl_event>(event_.get()));
  return event_.get();
}

void Context::wait(const Marker& marker) {
  const auto event = static_cast<cl_event>(marker.event_.get());
  const cl_int code = clWaitForEvents(1, &event);
  if (code != CL_SUCCESS) state_->fail(code, "waiting for the device");
}

void Context::flush() {
  try {
    state_->queue.flush();
  } catch (const cl::Error& error) {
    state_->fail(error.err(), "flushing the queue");
  }
}

StageSeconds Context::profile() {
  finish();
  try {
    StageSeconds out;
    for (const auto& [stage, seconds] : state_->profile.sums()) out.emplace(stage_name(stage), seconds);
    return out;
  } catch (const cl::Error& error) {
    state_->fail(error.err(), "reading the profile");
  }
}

KernelTimes Context::kernel_times() const { return state_->profile.kernels(); }

void Context::set_profiling(bool on) {
  if (on == state_->profile.on) return;
  if (on && !state_->timed())
    throw CallError("the queue was made without CL_QUEUE_PROFILING_ENABLE: make one with it to measure times");
  profile();  // pending events belong to the other queue
  try {
    if (!on && !state_->plain()) state_->plain = cl::CommandQueue(state_->context, state_->device, 0);
    state_->queue = on ? state_->timed : state_->plain;
    state_->profile.on = on;
  } catch (const cl::Error& error) {
    state_->fail(error.err(), "opening a queue");
  }
}

void Context::reset_profile() { state_->profile.reset(); }

Handles Context::handles() const { return {state_->context(), state_->device(), state_->queue()}; }

void Context::set_memory_advice(const std::string& advice) { state_->memory_advice = advice; }

void Context::State::fail(cl_int code, const std::string& action, const std::string& kernel) const {
  std::string message = fmt::format("{}: {} failed: {}", info.name, action, error_name(code));
  if (is_out_of_memory(code)) {
    message += fmt::format(". The device has {} MiB, {} MiB at most a buffer; this run holds {}. {}",
                           info.global_memory >> 20, info.max_buffer >> 20, allocations->summary(),
                           memory_advice.empty() ? BufferName("").advice : memory_advice.c_str());
  }
  // NVIDIA returns this for every call after a kernel has crashed.
  if (code == CL_INVALID_COMMAND_QUEUE) {
    if (!foreign) OpenContexts::of_process().forget(device);
    message += ". An earlier command broke the queue: a kernel out of its buffers' bounds?";
  }
  if (code == CL_MEM_OBJECT_ALLOCATION_FAILURE) throw BufferError(message, code, kernel);
  throw CallError(message, code, kernel);
}

}  // namespace wavetracer::gpu
