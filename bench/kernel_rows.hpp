// SPDX-License-Identifier: Apache-2.0
// Rows of bench_kernels: the time of one kernel beside the least time that its bytes, its random accesses, its
// operations and its launches allow on this device. Times are those by the device's clock.
#pragma once
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "device_limits.hpp"
#include "json_line.hpp"
#include "timing.hpp"

namespace wavetracer::bench {

// The least work of a kernel for one element, counted by reading the kernel.
struct KernelWork {
  double bytes = 0;       // read and written, next to those of neighbours
  double operations = 0;  // a fused multiply and add counts as two
  bool in_double = false;
  double gathers = 0;  // places of memory that are visited at random
  bool slots = false;  // such a place has 64 bytes, else at most eight
};

// One kernel as it was measured: in a frame, or alone.
struct MeasuredKernel {
  std::string kernel;   // "program/kernel"
  std::string variant;  // the world of the frame, or the form and the data of the kernel
  std::string element;  // in the plural
  double elements = 0, seconds = 0, launches = 0;
  KernelWork work;
  size_t samples = 0;
  double wrong = 0;  // results that are not as they must be; 0 where nothing is compared
  std::string remark = {};
};

// Elements and work of a kernel in a case that is measured without a frame.
struct KernelShare {
  std::string element;
  double elements = 0;
  KernelWork work;
};

struct KernelCase {
  std::string variant;
  std::map<std::string, KernelShare> kernels;  // by "program/kernel": those whose rows are printed
  std::function<void()> run;
  std::function<size_t()> wrong;          // counts errors after the first run
  std::function<void()> prepare = [] {};  // before each run, not timed
  std::string remark = {};
};

// Prints rows, and remembers which kernels have one.
class KernelRows {
 public:
  // wanted: the only kernels that get rows, by "program/kernel"; empty means all.
  KernelRows(gpu::DeviceInfo info, const DeviceLimits& limits, std::set<std::string, std::less<>> wanted, size_t runs,
             std::string command);

  bool wants(std::string_view kernel) const { return wanted_.empty() || wanted_.contains(kernel); }
  bool has(std::string_view kernel) const { return printed_.contains(kernel); }
  const gpu::DeviceInfo& info() const { return info_; }
  size_t runs() const { return runs_; }

  // Throws RuntimeError where results are wrong.
  void print(const MeasuredKernel& measured);
  // Runs a case once to warm up and to check it, then runs() times; prints medians of its kernels that are wanted. Does
  // nothing if none of them is.
  void measure(gpu::Context& context, const KernelCase& c);
  // Prints the number of kernels with a row, the limits of the device, and the names of `kernels` without one.
  void print_coverage(std::span<const std::string> kernels);

 private:
  gpu::DeviceInfo info_;
  DeviceLimits limits_;
  std::set<std::string, std::less<>> wanted_, printed_;
  size_t runs_;
  std::string command_;
};

}  // namespace wavetracer::bench
