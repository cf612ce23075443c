// SPDX-License-Identifier: Apache-2.0
// Device memory: allocation, transfers, fills and copies, all bounds checked. Reads and large writes wait for the
// device; when a call returns, the host's memory may be reused. A request of zero bytes gives a handle with bytes() =
// 0, backed by a few bytes, which may be a kernel's argument.
#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>
#include "gpu/state.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::gpu {

namespace {

constexpr size_t least_bytes = 16;

// NVIDIA's clEnqueueFillBuffer (driver 580.159) indexes pattern elements, including the offset, by 32-bit integers:
// from 2^31 elements on it hangs or crashes, from 2^32 on it fills a part and reports success. For larger fills, a seed
// is written and copied, doubling each time.
constexpr size_t most_fill_elements = size_t{1} << 30;
constexpr size_t fill_seed_bytes = size_t{1} << 22;

cl_mem handle_of(const std::shared_ptr<void>& handle) { return static_cast<cl_mem>(handle.get()); }

void check_bounds(const Allocations& allocations, void* handle, size_t size, const char* action, size_t offset,
                  size_t bytes) {
  if (offset <= size && bytes <= size - offset) return;
  throw std::out_of_range(
      fmt::format("{} buffer \"{}\": {} bytes at {} of {}", action, allocations.name(handle), bytes, offset, size));
}

void require(bool allocated, const char* action) {
  if (!allocated) throw std::logic_error(fmt::format("{} a buffer that was never allocated", action));
}

}  // namespace

void Allocations::add(void* handle, std::string name, size_t bytes) {
  live_.emplace(handle, Entry{std::move(name), bytes});
}

void Allocations::remove(void* handle) {
  if (const auto entry = live_.find(handle); entry != live_.end()) live_.erase(entry);
}

std::string Allocations::name(void* handle) const {
  const auto entry = live_.find(handle);
  return entry == live_.end() ? "" : entry->second.name;
}

std::string Allocations::summary() const {
  std::vector<Entry> entries;
  size_t total = 0;
  for (const auto& [handle, entry] : live_) {
    entries.push_back(entry);
    total += entry.bytes;
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.bytes > b.bytes; });
  std::string out = fmt::format("{} MiB in {} buffers", total >> 20, entries.size());
  for (size_t i = 0; i < std::min<size_t>(entries.size(), 4); ++i) {
    out += fmt::format("{}{} ({} MiB)", i == 0 ? ", the largest: " : ", ", entries[i].name, entries[i].bytes >> 20);
  }
  return out;
}

Memory Context::allocate(size_t bytes, const BufferName& name) {
  State& s = *state_;
  if (bytes > s.info.max_buffer) {
    throw BufferError(fmt::format(
        "{}: buffer \"{}\" needs {} bytes, more than the {} bytes that the device allows a buffer. {}", s.info.name,
        name.name, bytes, s.info.max_buffer, s.memory_advice.empty() ? name.advice : s.memory_advice.c_str()));
  }
  cl_int code = CL_SUCCESS;
  const cl_mem handle = clCreateBuffer(s.context(), CL_MEM_READ_WRITE, std::max(bytes, least_bytes), nullptr, &code);
  if (code != CL_SUCCESS) s.fail(code, fmt::format("allocating {} bytes for buffer \"{}\"", bytes, name.name));
  return adopt(handle, bytes, name.name);
}

Memory Context::adopt(void* memory, size_t bytes, const char* name) {
  state_->allocations->add(memory, name, bytes);
  Memory out;
  out.context_ = this;
  out.bytes_ = bytes;
  out.handle_ = std::shared_ptr<void>(memory, [allocations = state_->allocations](void* released) {
    allocations->remove(released);
    clReleaseMemObject(static_cast<cl_mem>(released));
  });
  return out;
}

HostMemory Context::host_memory(size_t bytes, const char* name) {
  State& s = *state_;
  cl_int code = CL_SUCCESS;
  const size_t size = std::max(bytes, least_bytes);
  const cl_mem handle = clCreateBuffer(s.context(), CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR, size, nullptr, &code);
  if (code != CL_SUCCESS) s.fail(code, fmt::format("allocating {} bytes of the host for \"{}\"", bytes, name));
  void* data =
      clEnqueueMapBuffer(s.queue(), handle, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE, 0, size, 0, nullptr, nullptr, &code);
  if (code != CL_SUCCESS) {
    clReleaseMemObject(handle);
    s.fail(code, fmt::format("mapping {} bytes of the host for \"{}\"", bytes, name));
  }
  HostMemory memory;
  memory.bytes_ = bytes;
  memory.data_ = std::shared_ptr<void>(data, [handle, queue = s.queue](void* mapped) {
    clEnqueueUnmapMemObject(queue(), handle, mapped, 0, nullptr, nullptr);
    clReleaseMemObject(handle);
  });
  return memory;
}

void Memory::read_to(const HostMemory& to, size_t place, size_t offset, size_t bytes, bool wait, Stage stage) const {
  if (place > to.bytes() || bytes > to.bytes() - place)
    throw std::out_of_range(
        fmt::format("reading {} bytes to byte {} of {} bytes of the host", bytes, place, to.bytes()));
  read_bytes(static_cast<char*>(to.data()) + place, offset, bytes, stage, wait);
}

void Memory::read_bytes(void* to, size_t offset, size_t bytes, Stage stage, bool wait) const {
  if (bytes == 0 && offset <= bytes_) return;
  require(static_cast<bool>(handle_), "reading");
  Context::State& s = *context_->state_;
  check_bounds(*s.allocations, handle_.get(), bytes_, "reading", offset, bytes);
  cl::Event event;
  const cl_int code = clEnqueueReadBuffer(s.queue(), handle_of(handle_), wait ? CL_TRUE : CL_FALSE, offset, bytes, to,
                                          0, nullptr, s.event_of(event));
  if (code != CL_SUCCESS) s.fail(code, fmt::format("reading buffer \"{}\"", s.allocations->name(handle_.get())));
  if (wait) s.staged.done();
  s.profile.add(stage, std::move(event));
}

void Memory::write_bytes(const void* from, size_t offset, size_t bytes, Stage stage) {
  if (bytes == 0 && offset <= bytes_) return;
  require(static_cast<bool>(handle_), "writing");
  Context::State& s = *context_->state_;
  check_bounds(*s.allocations, handle_.get(), bytes_, "writing", offset, bytes);
  const void* const copy = bytes <= StagedWrites::largest ? s.staged.stage(from, bytes) : nullptr;
  cl::Event event;
  const cl_int code = clEnqueueWriteBuffer(s.queue(), handle_of(handle_), copy ? CL_FALSE : CL_TRUE, offset, bytes,
                                           copy ? copy : from, 0, nullptr, s.event_of(event));
  if (code != CL_SUCCESS) s.fail(code, fmt::format("writing buffer \"{}\"", s.allocations->name(handle_.get())));
  if (!copy) s.staged.done();
  s.profile.add(stage, std::move(event));
}

void Context::fill(Memory& memory, const void* pattern, size_t pattern_bytes, size_t offset, size_t bytes,
                   Stage stage) {
  require(static_cast<bool>(memory.handle_), "filling");
  State& s = *state_;
  check_bounds(*s.allocations, memory.handle_.get(), memory.bytes_, "filling", offset, bytes);
  if (pattern_bytes > 8 || !std::has_single_bit(pattern_bytes) || offset % pattern_bytes || bytes % pattern_bytes) {
    throw std::logic_error(
        fmt::format("filling buffer \"{}\": a pattern of {} bytes does not fill {} bytes at {}; it must have 1, 2, "
                    "4 or 8 bytes and divide both",
                    s.allocations->name(memory.handle_.get()), pattern_bytes, bytes, offset));
  }
  if (bytes == 0) return;
  if ((offset + bytes) / pattern_bytes <= most_fill_elements) {
    cl::Event event;
    const cl_int code = clEnqueueFillBuffer(s.queue(), handle_of(memory.handle_), pattern, pattern_bytes, offset, bytes,
                                            0, nullptr, s.event_of(event));
    if (code != CL_SUCCESS) {
      s.fail(code, fmt::format("filling buffer \"{}\"", s.allocations->name(memory.handle_.get())));
    }
    s.profile.add(stage, std::move(event));
    return;
  }
  std::vector<unsigned char> seed(std::min(bytes, fill_seed_bytes));
  for (size_t i = 0; i < seed.size(); i += pattern_bytes) std::memcpy(seed.data() + i, pattern, pattern_bytes);
  memory.write_bytes(seed.data(), offset, seed.size(), stage);
  for (size_t done = seed.size(); done < bytes;) {
    const size_t next = std::min(done, bytes - done);
    s.copy(memory.handle_.get(), offset, memory.handle_.get(), offset + done, next, stage);
    done += next;
  }
}

void Context::copy(const Memory& from, Memory& to, size_t bytes, Stage stage) {
  if (bytes == 0) return;
  require(from.handle_ && to.handle_, "copying");
  State& s = *state_;
  check_bounds(*s.allocations, from.handle_.get(), from.bytes_, "copying from", 0, bytes);
  check_bounds(*s.allocations, to.handle_.get(), to.bytes_, "copying to", 0, bytes);
  if (from.handle_ == to.handle_) return;
  s.copy(from.handle_.get(), 0, to.handle_.get(), 0, bytes, stage);
}

void Context::State::copy(void* from, size_t from_offset, void* to, size_t to_offset, size_t bytes, Stage stage) {
  cl::Event event;
  const cl_int code = clEnqueueCopyBuffer(queue(), static_cast<cl_mem>(from), static_cast<cl_mem>(to), from_offset,
                                          to_offset, bytes, 0, nullptr, event_of(event));
  if (code != CL_SUCCESS) {
    fail(code, fmt::format("copying buffer \"{}\" to \"{}\"", allocations->name(from), allocations->name(to)));
  }
  profile.add(stage, std::move(event));
}

}  // namespace wavetracer::gpu
