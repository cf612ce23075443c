// SPDX-License-Identifier: Apache-2.0
// The sorts of CUDA's own libraries, CUB and Thrust, over the shapes that bench_sort asks for; one JSON object a line.
// Build: nvcc -O3 -arch=native -o cub_sort bench/peers/cub_sort.cu; then bench_sort --cub ./cub_sort
//
// Usage: cub_sort RUNS SHAPE...; a shape is u32 or u64, pairs or keys, n, bits: u32:pairs:4194304:32. Times are medians
// of RUNS by CUDA events, after one run that does not count. Keys are restored before each run. CUB's temporary memory
// is allocated beforehand; Thrust allocates its own in the time that is measured, as it does for its users.
#include <thrust/device_vector.h>
#include <thrust/sort.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cub/device/device_radix_sort.cuh>
#include <random>
#include <string>
#include <vector>

namespace {

void check(cudaError_t error, const char* action) {
  if (error == cudaSuccess) return;
  std::fprintf(stderr, "cub_sort: %s: %s\n", action, cudaGetErrorString(error));
  std::exit(1);
}

struct Shape {
  int key_bits = 32;
  bool payload = false;
  size_t n = 0;
  int bits = 32;
};

class Timer {
 public:
  Timer() {
    check(cudaEventCreate(&start_), "creating an event");
    check(cudaEventCreate(&end_), "creating an event");
  }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;
  ~Timer() {
    cudaEventDestroy(start_);
    cudaEventDestroy(end_);
  }
  // Median seconds of `sort`, with `restore` before each.
  template <class Restore, class Sort>
  double median(int runs, const Restore& restore, const Sort& sort) {
    std::vector<double> seconds;
    for (int run = -1; run < runs; run++) {
      restore();
      check(cudaDeviceSynchronize(), "restoring the keys");
      check(cudaEventRecord(start_), "recording an event");
      sort();
      check(cudaEventRecord(end_), "recording an event");
      check(cudaEventSynchronize(end_), "sorting");
      float milliseconds = 0;
      check(cudaEventElapsedTime(&milliseconds, start_, end_), "reading an event");
      if (run >= 0) seconds.push_back(milliseconds * 1e-3);
    }
    std::nth_element(seconds.begin(), seconds.begin() + runs / 2, seconds.end());
    return seconds[runs / 2];
  }

 private:
  cudaEvent_t start_, end_;
};

template <class Key>
void require_sorted(const thrust::device_vector<Key>& keys, const char* sort) {
  if (thrust::is_sorted(keys.begin(), keys.end())) return;
  std::fprintf(stderr, "cub_sort: %s left %zu keys unsorted\n", sort, keys.size());
  std::exit(1);
}

void print(const char* sort, const Shape& shape, double seconds) {
  std::printf("{\"sort\":\"%s\",\"key\":\"u%d\",\"payload\":%s,\"n\":%zu,\"bits\":%d,\"seconds\":%.9g}\n", sort,
              shape.key_bits, shape.payload ? "true" : "false", shape.n, shape.bits, seconds);
  std::fflush(stdout);
}

template <class Key>
void measure(const Shape& shape, int runs) {
  std::vector<Key> keys(shape.n);
  std::mt19937_64 generator(1);
  for (Key& key : keys) key = static_cast<Key>(generator() >> (64 - shape.bits));
  const thrust::device_vector<Key> given = keys;
  const size_t words = shape.payload ? shape.n : 0;
  thrust::device_vector<Key> sorted(shape.n), moved(shape.n);
  thrust::device_vector<uint32_t> values(words), moved_values(words);
  Timer timer;

  const Key* from = thrust::raw_pointer_cast(given.data());
  Key* to = thrust::raw_pointer_cast(moved.data());
  const uint32_t* from_values = thrust::raw_pointer_cast(values.data());
  uint32_t* to_values = thrust::raw_pointer_cast(moved_values.data());
  const auto count = static_cast<int>(shape.n);
  const auto cub_sort = [&](void* temporary, size_t& bytes) {
    if (shape.payload) {
      check(cub::DeviceRadixSort::SortPairs(temporary, bytes, from, to, from_values, to_values, count, 0, shape.bits),
            "SortPairs");
    } else {
      check(cub::DeviceRadixSort::SortKeys(temporary, bytes, from, to, count, 0, shape.bits), "SortKeys");
    }
  };
  size_t bytes = 0;
  cub_sort(nullptr, bytes);
  thrust::device_vector<unsigned char> temporary(bytes);
  // It leaves the given keys as they were: there is nothing to restore.
  print("CUB", shape,
        timer.median(
            runs, [] {}, [&] { cub_sort(thrust::raw_pointer_cast(temporary.data()), bytes); }));
  require_sorted(moved, "CUB");

  if (shape.bits < shape.key_bits) return;  // Thrust sorts by whole keys
  print("Thrust", shape,
        timer.median(
            runs, [&] { sorted = given; },
            [&] {
              if (shape.payload)
                thrust::sort_by_key(sorted.begin(), sorted.end(), values.begin());
              else
                thrust::sort(sorted.begin(), sorted.end());
            }));
  require_sorted(sorted, "Thrust");
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 0;
  if (runs < 1) {
    std::fprintf(stderr, "usage: cub_sort RUNS SHAPE..., such as cub_sort 7 u32:pairs:4194304:32\n");
    return 2;
  }
  for (int i = 2; i < argc; i++) {
    Shape shape;
    char kind[6];
    const bool read = std::sscanf(argv[i], "u%d:%5[a-z]:%zu:%d", &shape.key_bits, kind, &shape.n, &shape.bits) == 4;
    if (!read || (shape.key_bits != 32 && shape.key_bits != 64) || shape.n < 1 || shape.n > (size_t{1} << 30) ||
        shape.bits < 1 || shape.bits > shape.key_bits) {
      std::fprintf(stderr, "cub_sort: %s is no shape, such as u32:pairs:4194304:32\n", argv[i]);
      return 2;
    }
    shape.payload = std::string(kind) == "pairs";
    if (shape.key_bits == 32)
      measure<uint32_t>(shape, runs);
    else
      measure<uint64_t>(shape, runs);
  }
  return 0;
}
