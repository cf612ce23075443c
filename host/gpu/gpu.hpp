// SPDX-License-Identifier: Apache-2.0
// The device layer's interface: choice of a device, buffers that know their length, programs, checked launches,
// profiling. Only this folder names cl::; this header contains nothing of OpenCL's C++ bindings.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "gpu/call_error.hpp"
#include "gpu/device_info.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/kernel_time.hpp"
#include "wavetracer/stages.hpp"

namespace wavetracer::gpu {

// Numbers of work-items and the fixed work-group size, as one number or one per dimension; global is padded up to a
// multiple of local (PoCL has no non-uniform work-groups), so kernels must check their range.
struct Range {
  Range(size_t global_items, size_t local_items) : global{global_items, 1, 1}, local{local_items, 1, 1} {}
  Range(const std::array<size_t, 3>& global_items, const std::array<size_t, 3>& local_items, unsigned dimension_count)
      : global(global_items), local(local_items), dimensions(dimension_count) {}
  std::array<size_t, 3> global, local;  // 1 in unused dimensions
  unsigned dimensions = 1;

  bool empty() const { return global[0] == 0 || global[1] == 0 || global[2] == 0; }
};

// Preprocessor definitions of a program, name -> value. A name that begins with -cl- is an option of the compiler. They
// are part of the cache key.
using Definitions = std::map<std::string, std::string>;

class Context;

// The name of a buffer in messages, and advice for when it is too large.
struct BufferName {
  BufferName(const char* name_of_it,
             const char* advice_for_it =
                 "Lower trace.batch_rays, or trace.rays where it is not set, or choose a device with more memory")
      : name(name_of_it), advice(advice_for_it) {}
  const char* name;
  const char* advice;
};

// OpenCL's handles: a cl_context, a cl_device_id of it, and a cl_command_queue of both.
struct Handles {
  void *context = nullptr, *device = nullptr, *queue = nullptr;
};

// Host memory that the device copies to at full speed (pinned), for data that are read in every frame.
class HostMemory {
 public:
  HostMemory() = default;
  size_t bytes() const { return bytes_; }
  void* data() const { return data_.get(); }

 private:
  friend class Context;
  std::shared_ptr<void> data_;  // the mapped memory
  size_t bytes_ = 0;
};

// A place in the queue: Context::wait() returns once all commands before it are done.
class Marker {
 public:
  // Returns the cl_event that completes there, of which the caller owns a reference.
  void* retained_event() const;

 private:
  friend class Context;
  std::shared_ptr<void> event_;  // a cl_event
};

// Untyped device memory. Copies share the handle.
class Memory {
 public:
  Memory() = default;
  size_t bytes() const { return bytes_; }
  void* handle() const { return handle_.get(); }  // a cl_mem, or null
  explicit operator bool() const { return handle_ != nullptr; }

 protected:
  friend class Context;
  friend class Kernel;
  std::shared_ptr<void> handle_;  // a cl_mem
  Context* context_ = nullptr;
  size_t bytes_ = 0;
  void read_bytes(void* to, size_t offset, size_t bytes, Stage stage, bool wait = true) const;
  void write_bytes(const void* from, size_t offset, size_t bytes, Stage stage);
  // place: the first byte of `to` that is written.
  void read_to(const HostMemory& to, size_t place, size_t offset, size_t bytes, bool wait, Stage stage) const;
};

// A typed buffer of size() elements. Transfers are bounds checked (std::out_of_range), and do not use the host's memory
// after they return. A transfer of zero elements needs no buffer: a list that has been empty so far may have none.
template <class T>
class Buffer : public Memory {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Buffer() = default;
  // Takes the memory for elements of T.
  explicit Buffer(Memory m) : Memory(std::move(m)) {}
  size_t size() const { return bytes_ / sizeof(T); }
  void write(std::span<const T> data, size_t first = 0, Stage stage = Stage::transfer) {
    write_bytes(data.data(), first * sizeof(T), data.size_bytes(), stage);
  }
  std::vector<T> read(size_t first, size_t count, Stage stage = Stage::transfer) const {
    std::vector<T> out(count);
    read_bytes(out.data(), first * sizeof(T), count * sizeof(T), stage);
    return out;
  }
  std::vector<T> read() const { return read(0, size()); }
  void read_into(std::span<T> out, size_t first = 0, Stage stage = Stage::transfer) const {
    read_bytes(out.data(), first * sizeof(T), out.size_bytes(), stage);
  }
  // Reads into pinned memory, which must be large enough. The elements are valid until the memory is used again.
  std::span<const T> read(size_t first, size_t count, const HostMemory& to, Stage stage = Stage::transfer) const {
    read_to(to, 0, first * sizeof(T), count * sizeof(T), true, stage);
    return {static_cast<const T*>(to.data()), count};
  }
  // Does the same without waiting: the elements are valid after the next read that waits.
  void begin_read(size_t first, size_t count, const HostMemory& to, Stage stage = Stage::transfer) const {
    read_to(to, 0, first * sizeof(T), count * sizeof(T), false, stage);
  }
  // Does so for a part of a list: each element goes to the place in `to` that it has in the buffer.
  void begin_read_part(size_t first, size_t count, const HostMemory& to, Stage stage = Stage::transfer) const {
    read_to(to, first * sizeof(T), first * sizeof(T), count * sizeof(T), false, stage);
  }
  T read_one(size_t i, Stage stage = Stage::transfer) const {
    T out;
    read_bytes(&out, i * sizeof(T), sizeof(T), stage);
    return out;
  }
};

// A named kernel. Calling it sets every argument (count and sizes are checked against the kernel) and enqueues it;
// KernelOf (gpu/kernel_of.hpp) is a kernel whose arguments are checked where the host is compiled. stage: the profiling
// sum that its time is added to. Memory arguments are Buffers, or pointers to Buffers (a null pointer is NULL in the
// kernel); other arguments are plain values. A range of no items launches nothing, and then the buffers need not exist:
// a list that has been empty so far may have none.
class Kernel {
 public:
  Kernel() = default;
  template <class... Args>
  void operator()(Range range, Stage stage, const Args&... args) {
    check_count(sizeof...(Args));
    if (range.empty()) return;
    unsigned i = 0;
    (set(i++, args), ...);
    enqueue(range, stage);
  }
  const std::string& name() const;

 private:
  friend class Context;
  template <class Call>
  friend class KernelOf;
  struct State;
  std::shared_ptr<State> state_;
  void check_count(size_t count) const;
  void check_name(unsigned index, const char* name) const;
  void set_value(unsigned index, const void* value, size_t bytes);
  void set_memory(unsigned index, const Memory* memory);
  void enqueue(Range range, Stage stage);
  template <class T>
  void set(unsigned index, const T& value) {
    if constexpr (std::is_base_of_v<Memory, T>) {
      set_memory(index, &value);
    } else if constexpr (std::is_pointer_v<T>) {
      set_memory(index, value);
    } else {
      static_assert(std::is_trivially_copyable_v<T>);
      set_value(index, &value, sizeof(T));
    }
  }
};

// One device with its context, one in-order profiling queue, its program cache and its profile. It is not thread-safe.
class Context {
 public:
  // Throws DeviceError if choose_device() does, or if the device lacks one of the needs.
  explicit Context(std::string_view device_text = "", const Needs& needs = Needs());
  // Uses the handles of somebody else, and retains them. Profiling is off, and can be on only if the queue has
  // CL_QUEUE_PROFILING_ENABLE. Throws CallError if a handle is null, if the queue is not one of this context and device
  // or is out of order, or if the device lacks one of the needs.
  Context(const Handles& handles, const Needs& needs);
  // Waits for the queue; one of somebody else only while it may still read copies that this context keeps.
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const DeviceInfo& info() const;
  // The handles in use, which the context owns or retains.
  Handles handles() const;
  // Replaces the advice of all messages about too little memory, which else names keys of the configuration.
  void set_memory_advice(const std::string& advice);

  // Returns the cl_mem of somebody else as memory, and retains it. Throws CallError if it is null, no buffer, or one of
  // another context.
  Memory wrap(void* memory, const BufferName& name);
  // The same for a part of it, a sub-buffer. Throws CallError also if the part leaves the buffer or has no bytes, or if
  // its offset is not aligned as the device demands.
  Memory wrap(void* memory, size_t offset, size_t bytes, const BufferName& name);

  // The commands that are enqueued from now on start after these cl_event.
  void wait_for(std::span<void* const> events);

  // Throws BufferError that names the buffer, its size, the device's limit and what to lower.
  template <class T>
  Buffer<T> buffer(size_t count, const BufferName& name) {
    return Buffer<T>(allocate(count * sizeof(T), name));
  }
  template <class T>
  Buffer<T> buffer(const std::vector<T>& data, const BufferName& name) {
    auto b = buffer<T>(data.empty() ? 1 : data.size(), name);
    if (!data.empty()) b.write(data);
    return b;
  }
  // Throws DeviceError as buffer() does.
  HostMemory host_memory(size_t bytes, const char* name);
  // Fills memory with a repeated pattern of 1, 2, 4 or 8 bytes.
  void fill(Memory& memory, const void* pattern, size_t pattern_bytes, size_t offset, size_t bytes, Stage stage);
  template <class T>
  void fill(Buffer<T>& buffer, const std::type_identity_t<T>& value, Stage stage = Stage::transfer) {
    fill(buffer, &value, sizeof(T), 0, buffer.bytes(), stage);
  }
  void copy(const Memory& from, Memory& to, size_t bytes, Stage stage = Stage::transfer);

  // Returns kernel `kernel` of the file `program`.cl built with these definitions; it is compiled once per process and
  // cached on disk. CPUs take seconds to compile, so there it is built at its first launch, which throws its errors
  // (DeviceError); on other devices it is built here.
  Kernel kernel(const std::string& program, const std::string& kernel, const Definitions& definitions = {});

  // Returns the text that was last kept for this subject: measurements of this device, kept on disk beside its
  // programs.
  std::optional<std::string> recall(const std::string& subject) const;
  void keep(const std::string& subject, const std::string& text);

  void finish();
  // Marks this place in the queue.
  Marker mark();
  void wait(const Marker& marker);
  // Hands enqueued commands to the device, without waiting for them.
  void flush();

  // Returns sums of the profiling events since the last reset, seconds per stage; finishes the queue first.
  StageSeconds profile();
  // Returns the same sums by kernel, without copies; call it after profile().
  KernelTimes kernel_times() const;
  void reset_profile();
  // Profiling is on at first, but for a queue of somebody else. If it is off, profile() adds nothing, and launches in
  // quick succession cost less (on an H200 about half). Finishes the queue. Throws CallError if it cannot be on.
  void set_profiling(bool on);
  // Returns the seconds spent building programs so far (from source or from the disk cache), and how many were built
  // from source.
  double build_seconds() const;
  // Returns notes for the user about caches on the disk that cannot be written to.
  std::vector<std::string> notes() const;
  size_t builds_from_source() const;

 private:
  friend class Memory;
  friend class Kernel;
  struct State;
  std::unique_ptr<State> state_;
  Memory allocate(size_t bytes, const BufferName& name);
  Memory adopt(void* memory, size_t bytes, const char* name);
};

// Returns the source of a program after expansion of its #include lines, with #line kept; for tests and for `bench`.
std::string program_source(const std::string& program);

// Returns a hash of the text of all kernels and of the headers that they share with the host, from wherever they are
// read.
std::string hash_of_sources();

}  // namespace wavetracer::gpu
