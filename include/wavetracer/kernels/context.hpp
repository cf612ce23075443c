// SPDX-License-Identifier: Apache-2.0
// Context: the device and the queue that the kernel suite uses, which are the user's own or opened by name. Memory and
// Buffer: device memory, which is the user's own cl_mem or allocated here. Call: events before and after.
//
// Passes (sort.hpp, scan.hpp, compact.hpp) are objects that are made once for a context and called many times: kernels
// are built when a pass is made, on CPUs at its first call. A call only enqueues commands and returns before they have
// run. Any number of contexts may be used at the same time, one thread each, also with queues of one cl_context;
// a context with its buffers and passes may be used by one thread at a time.
//
// Nothing is kept for the process. Compiled programs are kept on the disk for the next process
// ($WAVETRACER_CACHE_DIR, else $XDG_CACHE_HOME/wavetracer, else ~/.cache/wavetracer).
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "wavetracer/kernels/error.hpp"

namespace wavetracer::kernels {

// The events of a call. Its commands run after all commands that are already in the queue of the context, so a user of
// one queue needs no events.
struct Call {
  // The first command of the call starts after these events, which may belong to other queues of the same cl_context.
  // They are read during the call alone.
  std::span<const cl_event> after = {};
  // If not null, *done becomes an event that completes with the last command of the call. The caller owns it
  // (clReleaseEvent). The queue is flushed, so that other queues may wait for it.
  // It stays as it was if the call throws.
  cl_event* done = nullptr;
};

// Untyped device memory. Copies share it.
class Memory {
 public:
  struct State;  // the suite alone knows it
  Memory();
  ~Memory();
  Memory(const Memory&);
  Memory(Memory&&) noexcept;
  Memory& operator=(const Memory&);
  Memory& operator=(Memory&&) noexcept;

  // Bytes of it; 0 if there is none.
  size_t bytes() const;
  // The cl_mem, which lives as long as this object; the caller does not own it. Null if there is none.
  cl_mem handle() const;
  explicit operator bool() const { return state_ != nullptr; }
  const State* state() const { return state_.get(); }

 protected:
  friend class Context;
  std::shared_ptr<const State> state_;
  void write_bytes(const void* from, size_t offset, size_t bytes, const Call& call) const;
  void read_bytes(void* to, size_t offset, size_t bytes, const Call& call) const;
  [[noreturn]] static void refuse_range(size_t first, size_t count, size_t size);
};

// Memory with elements of a plain type that the host and the device lay out alike.
template <class T>
class Buffer : public Memory {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Buffer() = default;
  // The elements that fit into the memory.
  size_t size() const { return bytes() / sizeof(T); }
  // Copies data to elements `first` and following ones. The host's memory may be used again when it returns. Throws
  // Error if the buffer ends before them.
  void write(std::span<const T> data, size_t first = 0, const Call& call = {}) const {
    write_bytes(data.data(), first * sizeof(T), data.size_bytes(), call);
  }
  // Returns `count` elements from `first` on. Waits for the queue. Throws Error if the buffer ends before them.
  std::vector<T> read(size_t first, size_t count, const Call& call = {}) const {
    if (first > size() || count > size() - first) refuse_range(first, count, size());
    std::vector<T> out(count);
    read_bytes(out.data(), first * sizeof(T), count * sizeof(T), call);
    return out;
  }
  std::vector<T> read() const { return read(0, size()); }

 private:
  friend class Context;
  explicit Buffer(Memory memory) : Memory(std::move(memory)) {}
};

class Context {
 public:
  struct State;  // the suite alone knows it
  // Uses the caller's context, device and queue. They are retained, so the caller may release them before this object.
  // The queue must be in order, because passes of many launches rely on it, and must belong to the context and to the
  // device. Nothing else is asked of the device: a pass that needs double precision or 64-bit atomics says so and
  // throws when it is made. Throws Error.
  Context(cl_context context, cl_device_id device, cl_command_queue queue);
  // Opens a device and a queue of its own. device: empty takes the first GPU, else the first CPU; a number is an index
  // in the list that `wavetracer devices` prints; any other text must be a part of a device's or platform's name.
  // Throws Error with the list of devices.
  explicit Context(std::string_view device = "");
  // Waits for the queue if the host's memory is still being read (after Buffer::write of some KiB); the commands of
  // passes go on without it. Buffers and passes may outlive it.
  ~Context();
  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;

  // The handles, which the caller does not own.
  cl_context context() const;
  cl_device_id device() const;
  cl_command_queue queue() const;
  // The device's name.
  const std::string& name() const;

  // Returns the cl_mem as a buffer without a copy. It is retained as long as the buffer lives, so it may be released
  // before. It must be a buffer (no image or pipe) of this cl_context, which kernels may read and write. Two wraps of
  // one cl_mem are the same memory. Throws Error.
  template <class T>
  Buffer<T> wrap(cl_mem memory) const {
    return Buffer<T>(wrap_bytes(memory));
  }
  // The same for `count` elements from `first` on, as a sub-buffer: `first * sizeof(T)` must be a multiple of the
  // device's CL_DEVICE_MEM_BASE_ADDR_ALIGN / 8 bytes, and `memory` no sub-buffer itself. Throws Error.
  template <class T>
  Buffer<T> wrap(cl_mem memory, size_t first, size_t count) const {
    return Buffer<T>(wrap_range(memory, first, count, sizeof(T)));
  }
  // Allocates `count` elements, whose contents are undefined. Throws Error that names the sizes if there is no room.
  template <class T>
  Buffer<T> buffer(size_t count) const {
    return Buffer<T>(allocate(count, sizeof(T)));
  }

  // Waits for all commands of the queue.
  void finish() const;

  const std::shared_ptr<State>& state() const { return state_; }

 private:
  std::shared_ptr<State> state_;
  Memory wrap_bytes(cl_mem memory) const;
  Memory wrap_range(cl_mem memory, size_t first, size_t count, size_t element_bytes) const;
  Memory allocate(size_t count, size_t element_bytes) const;
};

}  // namespace wavetracer::kernels
