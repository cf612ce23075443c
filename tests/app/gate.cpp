// SPDX-License-Identifier: Apache-2.0
// A library to load before the program (LD_PRELOAD): its processes wait where a test wants them, until the test lets
// them go on. So no test depends on how fast a machine is. app/gate.hpp drives it. GATE=FOLDER turns it on. A process
// that waits has a file FOLDER/waits.PID, and all go on once FOLDER/open is there. GATE_AT=TEXT: a process that gives a
// file a name with TEXT in it waits before it does so, unless the name contains GATE_NOT. GATE_SYNC=1: a process that
// syncs a file system (syncfs) waits. GATE_LAUNCHES=1: launches of kernels beyond the number that FOLDER/launches holds
// wait. GATE_LARGEST=BYTES: the device has no memory for larger buffers.
#include <CL/cl.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

const char* setting(const char* name) {
  const char* const value = std::getenv(name);
  return value && *value ? value : nullptr;
}

template <typename Function>
Function original(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

bool exists(const std::string& file) { return access(file.c_str(), F_OK) == 0; }

long launches_allowed(const std::string& folder) {
  char text[32] = {};
  const int file = open((folder + "/launches").c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  const ssize_t size = read(file, text, sizeof text - 1);
  close(file);
  return size > 0 ? std::atol(text) : 0;
}

template <typename Closed>
void wait_while(const Closed& closed) {
  const int error = errno;
  const std::string folder = setting("GATE"), mark = folder + "/waits." + std::to_string(getpid());
  if (!exists(folder + "/open") && closed()) {
    close(open(mark.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
    while (!exists(folder + "/open") && closed()) usleep(1000);
    unlink(mark.c_str());
  }
  errno = error;
}

}  // namespace

extern "C" {

int rename(const char* from, const char* to) noexcept {
  const char *const at = setting("GATE_AT"), *const without = setting("GATE_NOT");
  if (setting("GATE") && at && std::strstr(to, at) && !(without && std::strstr(to, without)))
    wait_while([] { return true; });
  static const auto call = original<int (*)(const char*, const char*)>("rename");
  return call(from, to);
}

int syncfs(int descriptor) noexcept {
  if (setting("GATE") && setting("GATE_SYNC")) wait_while([] { return true; });
  static const auto call = original<int (*)(int)>("syncfs");
  return call(descriptor);
}

cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t bytes, void* host, cl_int* error) {
  if (const char* const largest = setting("GATE_LARGEST"); largest && bytes > std::strtoull(largest, nullptr, 10)) {
    if (error) *error = CL_MEM_OBJECT_ALLOCATION_FAILURE;
    return nullptr;
  }
  static const auto create = original<decltype(&clCreateBuffer)>("clCreateBuffer");
  return create(context, flags, bytes, host, error);
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset,
                              const size_t* global, const size_t* local, cl_uint waits, const cl_event* wait_list,
                              cl_event* event) {
  static std::atomic<long> launches{0};
  const long number = ++launches;
  if (setting("GATE") && setting("GATE_LAUNCHES"))
    wait_while([number] { return number > launches_allowed(setting("GATE")); });
  static const auto launch = original<decltype(&clEnqueueNDRangeKernel)>("clEnqueueNDRangeKernel");
  return launch(queue, kernel, dimensions, offset, global, local, waits, wait_list, event);
}

}  // extern "C"
