// SPDX-License-Identifier: Apache-2.0
// A user of OpenCL's C interface, with his own handles, who has never heard of wavetracer's classes.
// Failures are exceptions that name the code.
#pragma once
#include <CL/cl.h>

#include <cstdint>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace wavetracer::test {

inline void check_code(cl_int code, const char* call) {
  if (code != CL_SUCCESS) throw std::runtime_error(std::string(call) + " failed with " + std::to_string(code));
}

// The first device of the platform that WAVETRACER_TEST_PLATFORM names, else of the first platform that has one.
inline cl_device_id users_device() {
  cl_uint count = 0;
  check_code(clGetPlatformIDs(0, nullptr, &count), "clGetPlatformIDs");
  std::vector<cl_platform_id> platforms(count);
  check_code(clGetPlatformIDs(count, platforms.data(), nullptr), "clGetPlatformIDs");
  const char* const expected = std::getenv("WAVETRACER_TEST_PLATFORM");
  for (const cl_platform_id platform : platforms) {
    char name[256] = "";
    check_code(clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof name, name, nullptr), "clGetPlatformInfo");
    cl_device_id device = nullptr;
    if (expected && std::string(name) != expected) continue;
    if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, nullptr) == CL_SUCCESS) return device;
  }
  throw std::runtime_error("no OpenCL device");
}

struct User {
  cl_device_id device = users_device();
  cl_context context = nullptr;
  cl_command_queue queue = nullptr;

  explicit User(cl_command_queue_properties properties = 0) {
    cl_int code = CL_SUCCESS;
    context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, &code);
    check_code(code, "clCreateContext");
    queue = new_queue(properties);
  }
  ~User() {
    if (queue) clReleaseCommandQueue(queue);
    if (context) clReleaseContext(context);
  }
  User(const User&) = delete;
  User& operator=(const User&) = delete;

  cl_command_queue new_queue(cl_command_queue_properties properties = 0) const {
    cl_int code = CL_SUCCESS;
    const cl_queue_properties list[] = {CL_QUEUE_PROPERTIES, properties, 0};
    const cl_command_queue made =
        clCreateCommandQueueWithProperties(context, device, properties ? list : nullptr, &code);
    check_code(code, "clCreateCommandQueueWithProperties");
    return made;
  }

  // Memory with these elements, or with `bytes` of anything. The caller releases it.
  template <class T>
  cl_mem memory(const std::vector<T>& data) const {
    cl_int code = CL_SUCCESS;
    const cl_mem made = clCreateBuffer(context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, data.size() * sizeof(T),
                                       const_cast<T*>(data.data()), &code);
    check_code(code, "clCreateBuffer");
    return made;
  }
  cl_mem memory(size_t bytes) const {
    cl_int code = CL_SUCCESS;
    const cl_mem made = clCreateBuffer(context, CL_MEM_READ_WRITE, bytes, nullptr, &code);
    check_code(code, "clCreateBuffer");
    return made;
  }
  template <class T>
  std::vector<T> read(cl_mem memory, size_t count, cl_command_queue from = nullptr) const {
    std::vector<T> out(count);
    check_code(clEnqueueReadBuffer(from ? from : queue, memory, CL_TRUE, 0, count * sizeof(T), out.data(), 0, nullptr,
                                   nullptr),
               "clEnqueueReadBuffer");
    return out;
  }
};

inline cl_uint references(cl_mem memory) {
  cl_uint count = 0;
  check_code(clGetMemObjectInfo(memory, CL_MEM_REFERENCE_COUNT, sizeof count, &count, nullptr), "clGetMemObjectInfo");
  return count;
}

template <class Key>
std::vector<Key> random_keys(size_t n, uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::vector<Key> out(n);
  for (Key& key : out) key = static_cast<Key>(random());
  return out;
}

}  // namespace wavetracer::test
