// SPDX-License-Identifier: Apache-2.0
// A library to load before the program (LD_PRELOAD): it makes system calls fail from a given one on.
// Each is off unless its variable is set: FAULT_LAUNCH=N and FAULT_BUFFER=N, the N-th launch of a kernel and all later
// ones, the N-th device buffer and all later ones, FAULT_CODE what they return; FAULT_DISK=N, the N-th write to a file
// and all later ones find the disk full; FAULT_MEMORY=BYTES, no allocation of the host may be as large.
#include <CL/cl.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <new>

namespace {

long setting(const char* name) {
  const char* text = std::getenv(name);
  return text ? std::atol(text) : 0;
}

// Tells whether this is the N-th call or a later one, with N from the variable.
class Countdown {
 public:
  explicit Countdown(const char* variable) : from_(setting(variable)) {}
  bool over() { return from_ > 0 && ++calls_ >= from_; }

 private:
  long from_;
  std::atomic<long> calls_{0};
};

template <typename Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

cl_int fault_code() {
  const long code = setting("FAULT_CODE");
  return static_cast<cl_int>(code ? code : CL_DEVICE_NOT_AVAILABLE);
}

bool is_file(int descriptor) {
  struct stat status;
  return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && descriptor > 2;
}

bool disk_is_full(int descriptor) {
  static Countdown countdown("FAULT_DISK");
  return is_file(descriptor) && countdown.over();
}

}  // namespace

extern "C" {

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset,
                              const size_t* global, const size_t* local, cl_uint waits, const cl_event* wait_list,
                              cl_event* event) {
  static Countdown countdown("FAULT_LAUNCH");
  if (countdown.over()) return fault_code();
  static const auto launch = next<decltype(&clEnqueueNDRangeKernel)>("clEnqueueNDRangeKernel");
  return launch(queue, kernel, dimensions, offset, global, local, waits, wait_list, event);
}

cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t size, void* host, cl_int* code) {
  static Countdown countdown("FAULT_BUFFER");
  if (countdown.over()) {
    if (code) *code = fault_code();
    return nullptr;
  }
  static const auto create = next<decltype(&clCreateBuffer)>("clCreateBuffer");
  return create(context, flags, size, host, code);
}

ssize_t write(int descriptor, const void* bytes, size_t count) {
  if (disk_is_full(descriptor)) {
    errno = ENOSPC;
    return -1;
  }
  static const auto call = next<ssize_t (*)(int, const void*, size_t)>("write");
  return call(descriptor, bytes, count);
}

int posix_fallocate64(int descriptor, off_t offset, off_t length) {
  if (disk_is_full(descriptor)) return ENOSPC;
  static const auto call = next<int (*)(int, off_t, off_t)>("posix_fallocate64");
  return call(descriptor, offset, length);
}

int posix_fallocate(int descriptor, off_t offset, off_t length) {
  if (disk_is_full(descriptor)) return ENOSPC;
  static const auto call = next<int (*)(int, off_t, off_t)>("posix_fallocate");
  return call(descriptor, offset, length);
}

}  // extern "C"

void* operator new(size_t bytes) {
  static const long limit = setting("FAULT_MEMORY");
  if (limit > 0 && bytes >= static_cast<size_t>(limit)) throw std::bad_alloc();
  if (void* memory = std::malloc(bytes ? bytes : 1)) return memory;
  throw std::bad_alloc();
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
