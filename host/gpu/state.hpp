// SPDX-License-Identifier: Apache-2.0
// The private halves of Context and Kernel, shared by this folder's .cpp files.
// A Context::State does not move during its life; kernels and buffers keep plain pointers to it.
#pragma once
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>
#include "gpu/cache.hpp"
#include "gpu/gpu.hpp"
#include "gpu/opencl.hpp"
#include "gpu/profile.hpp"

namespace wavetracer::gpu {

// The existing buffers, for messages. It outlives its Context if a buffer does.
class Allocations {
 public:
  void add(void* handle, std::string name, size_t bytes);
  void remove(void* handle);
  std::string name(void* handle) const;
  // Returns text such as "1234 MiB in 17 buffers, the largest: rays (512 MiB), hits (256 MiB)".
  std::string summary() const;

 private:
  struct Entry {
    std::string name;
    size_t bytes;
  };
  std::multimap<void*, Entry> live_;  // a cl_mem of somebody else may have been wrapped twice
};

// The host's copies of small writes, which therefore need not wait for the device. A copy must stay until the queue has
// executed the write: whenever the host waits for the queue, all of them are done.
class StagedWrites {
 public:
  static constexpr size_t largest = 16 << 10;  // largest write in bytes
  // Returns null if there is no space left before the next done().
  const void* stage(const void* from, size_t bytes) {
    if (bytes > ring_.size() - used_) return nullptr;
    void* const to = ring_.data() + used_;
    std::memcpy(to, from, bytes);
    used_ += (bytes + 15) / 16 * 16;
    return to;
  }
  void done() { used_ = 0; }
  bool any() const { return used_ != 0; }

 private:
  std::vector<unsigned char> ring_ = std::vector<unsigned char>(size_t{1} << 20);  // a multiple of 16
  size_t used_ = 0;
};

struct Context::State {
  DeviceInfo info;
  cl::Device device;
  cl::Context context;
  cl::CommandQueue queue;         // the queue in use: one of the next two, which are both in order
  cl::CommandQueue timed, plain;  // with and without profiling events; plain is opened at its first use
  bool foreign = false;           // handles are somebody else's; timed is missing if the queue has no profiling
  std::string memory_advice;      // replaces the advice of buffers, unless it is empty
  std::string device_options;
  ProgramCache cache = ProgramCache::from_environment();
  std::string cache_note;  // message for the user about programs that could not be kept
  Profile profile;
  // Returns where a command should store its event: nowhere without profiling.
  cl_event* event_of(cl::Event& event) { return profile.on ? &event() : nullptr; }
  StagedWrites staged;
  std::shared_ptr<Allocations> allocations = std::make_shared<Allocations>();
  std::map<std::string, cl::Program> programs;                    // keys are the kernel (on CPUs), name and options
  std::map<std::string, std::shared_ptr<Kernel::State>> kernels;  // keys are name, program and options
  bool locked = false;  // by a compiler that threw: nothing may be released, as that would wait for ever
  double build_seconds = 0;
  size_t builds_from_source = 0;

  // Returns a program, on CPUs with this kernel alone, built at its first use: from the disk cache, else from source.
  const cl::Program& program(const std::string& name, const std::string& kernel, const std::string& options);
  cl::Program build_from_source(const std::string& name, const std::string& kernel, const std::string& options,
                                const std::string& source);
  // Enqueues a copy between two cl_mem; the ranges must not overlap.
  void copy(void* from, size_t from_offset, void* to, size_t to_offset, size_t bytes, Stage stage);
  // Throws CallError (BufferError if memory ran out): what was tried, the error's name and what to lower. kernel: the
  // "program/kernel" that was being launched.
  [[noreturn]] void fail(cl_int code, const std::string& action, const std::string& kernel = {}) const;
};

// One argument of a kernel, as far as the runtime describes it.
struct Argument {
  enum class Kind { unknown, value, memory, local } kind = Kind::unknown;
  size_t bytes = 0;  // size of a value; 0 if its type is not one of OpenCL C's own
  std::string name, type;
};

struct Kernel::State {
  Context::State* context;
  std::string program, options, name, profile_name;  // profile_name is "program/kernel"
  cl::Kernel kernel;                                 // set by make(), like the following members
  size_t argument_count;
  std::vector<Argument> arguments;  // empty if the runtime does not describe them

  // Builds the program and makes the kernel, unless that has been done.
  void make();

  // Returns text such as "argument 2 (global uint* counts) of kernel trace".
  std::string describe(unsigned index) const;
};

}  // namespace wavetracer::gpu
