// The private halves of Context and Kernel, shared by this folder's .cpp files.
// A Context::State stays where it is for its whole life; kernels and buffers keep plain pointers to it.
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

// The buffers that are alive, for messages. Outlives its Context where a buffer does.
class Allocations {
 public:
  void add(void* handle, std::string name, size_t bytes);
  void remove(void* handle);
  std::string name(void* handle) const;
  // "1234 MiB in 17 buffers, the largest: rays (512 MiB), hits (256 MiB)".
  std::string summary() const;

 private:
  struct Entry {
    std::string name;
    size_t bytes;
  };
  std::map<void*, Entry> live_;
};

// The host's copies of small writes, which therefore need not wait for the device. A copy must stay until the queue has
// come to it: wherever the host waits for the queue, all of them are done.
class StagedWrites {
 public:
  static constexpr size_t largest = 16 << 10;  // bytes of a write
  // Null where there is no room left before the next done().
  const void* stage(const void* from, size_t bytes) {
    if (bytes > ring_.size() - used_) return nullptr;
    void* const to = ring_.data() + used_;
    std::memcpy(to, from, bytes);
    used_ += (bytes + 15) / 16 * 16;
    return to;
  }
  void done() { used_ = 0; }

 private:
  std::vector<unsigned char> ring_ = std::vector<unsigned char>(size_t{1} << 20);  // a multiple of 16
  size_t used_ = 0;
};

struct Context::State {
  DeviceInfo info;
  cl::Device device;
  cl::Context context;
  cl::CommandQueue queue;         // the one in use: of these two, both in order
  cl::CommandQueue timed, plain;  // with profiling events and without; plain is opened at its first use
  std::string device_options;
  ProgramCache cache = ProgramCache::from_environment();
  std::string cache_note;  // what to tell the user of programs that could not be kept
  Profile profile;
  // Where a command is to leave its event: nowhere, without profiling.
  cl_event* event_of(cl::Event& event) { return profile.on ? &event() : nullptr; }
  StagedWrites staged;
  std::shared_ptr<Allocations> allocations = std::make_shared<Allocations>();
  std::map<std::string, cl::Program> programs;                    // by kernel (on CPUs), name and options
  std::map<std::string, std::shared_ptr<Kernel::State>> kernels;  // by name, program and options
  bool locked = false;  // by a compiler that has thrown: nothing may be released, as that would wait for ever
  double build_seconds = 0;
  size_t builds_from_source = 0;

  // A program, on CPUs with this kernel alone, built at its first use: from the disk cache, else from source.
  const cl::Program& program(const std::string& name, const std::string& kernel, const std::string& options);
  cl::Program build_from_source(const std::string& name, const std::string& options, const std::string& source);
  // Enqueues a copy between two cl_mem, the ranges of which do not overlap.
  void copy(void* from, size_t from_offset, void* to, size_t to_offset, size_t bytes, Stage stage);
  // Throws DeviceError (BufferError where memory ran out): what was tried, the error's name and what to lower.
  [[noreturn]] void fail(cl_int code, const std::string& action) const;
};

// What a kernel wants as one argument, as far as the runtime tells.
struct Argument {
  enum class Kind { unknown, value, memory, local } kind = Kind::unknown;
  size_t bytes = 0;  // of a value; 0 where its type is not one of OpenCL C's own
  std::string name, type;
};

struct Kernel::State {
  Context::State* context;
  std::string program, options, name, profile_name;  // of which the last is "program/kernel"
  cl::Kernel kernel;                                 // this, and what follows: once it is made
  size_t argument_count;
  std::vector<Argument> arguments;  // empty where the runtime tells nothing

  // Builds the program and makes the kernel, where that has not been done.
  void make();

  // "argument 2 (global uint* counts) of kernel trace".
  std::string describe(unsigned index) const;
};

}  // namespace wavetracer::gpu
