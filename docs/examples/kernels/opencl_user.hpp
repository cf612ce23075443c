// SPDX-License-Identifier: Apache-2.0
// A user of OpenCL has this already: a device by its index over all platforms, a context, an in-order queue.
#pragma once
#include <CL/cl.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

inline void check(cl_int code, const char* call) {
  if (code == CL_SUCCESS) return;
  std::fprintf(stderr, "%s failed with %d\n", call, code);
  std::exit(1);
}

struct OpenClUser {
  cl_device_id device = nullptr;
  cl_context context = nullptr;
  cl_command_queue queue = nullptr;
  std::string name;

  explicit OpenClUser(unsigned index) : device(device_of(index)) {
    cl_int code = CL_SUCCESS;
    context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, &code);
    check(code, "clCreateContext");
    queue = clCreateCommandQueueWithProperties(context, device, nullptr, &code);
    check(code, "clCreateCommandQueueWithProperties");
    char text[256] = "";
    check(clGetDeviceInfo(device, CL_DEVICE_NAME, sizeof text, text, nullptr), "clGetDeviceInfo");
    name = text;
  }
  ~OpenClUser() {
    clReleaseCommandQueue(queue);
    clReleaseContext(context);
  }
  OpenClUser(const OpenClUser&) = delete;
  OpenClUser& operator=(const OpenClUser&) = delete;

  // Memory with these elements, or with room for so many bytes. The caller releases it.
  template <class T>
  cl_mem memory(const std::vector<T>& data) const {
    cl_int code = CL_SUCCESS;
    const cl_mem made = clCreateBuffer(context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, data.size() * sizeof(T),
                                       const_cast<T*>(data.data()), &code);
    check(code, "clCreateBuffer");
    return made;
  }
  cl_mem memory(size_t bytes) const {
    cl_int code = CL_SUCCESS;
    const cl_mem made = clCreateBuffer(context, CL_MEM_READ_WRITE, bytes, nullptr, &code);
    check(code, "clCreateBuffer");
    return made;
  }
  template <class T>
  std::vector<T> read(cl_mem memory, size_t count) const {
    std::vector<T> out(count);
    check(clEnqueueReadBuffer(queue, memory, CL_TRUE, 0, count * sizeof(T), out.data(), 0, nullptr, nullptr),
          "clEnqueueReadBuffer");
    return out;
  }

 private:
  static cl_device_id device_of(unsigned index) {
    cl_uint platform_count = 0;
    check(clGetPlatformIDs(0, nullptr, &platform_count), "clGetPlatformIDs");
    std::vector<cl_platform_id> platforms(platform_count);
    check(clGetPlatformIDs(platform_count, platforms.data(), nullptr), "clGetPlatformIDs");
    for (const cl_platform_id platform : platforms) {
      cl_uint count = 0;
      if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count) != CL_SUCCESS) continue;
      std::vector<cl_device_id> devices(count);
      check(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, devices.data(), nullptr), "clGetDeviceIDs");
      if (index < count) return devices[index];
      index -= count;
    }
    std::fprintf(stderr, "there is no such device\n");
    std::exit(1);
  }
};
