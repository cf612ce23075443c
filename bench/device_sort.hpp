// SPDX-License-Identifier: Apache-2.0
// Runs our sorts for the sort benchmark: over one array of keys, restored on the device before each run, and checked on
// the host. Only the lowest `bits` bits of keys differ.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "gpu/gpu.hpp"
#include "passes/payload.hpp"
#include "passes/radix_sort.hpp"

namespace wavetracer::bench {

struct SortSeconds {
  double wall = 0;    // from the first launch until all is done, as a user waits, without profiling
  double device = 0;  // the kernels alone, by the device's clock, in a separate run
};

// Random keys of which only the lowest `bits` bits differ, the same in every run and on every machine.
template <class Key>
std::vector<Key> keys_of_bits(uint32_t n, unsigned bits) {
  std::mt19937_64 generator(1);
  std::vector<Key> keys(n);
  for (Key& key : keys) key = static_cast<Key>(generator() >> (64 - bits));
  return keys;
}

template <class Key>
class DeviceKeys {
 public:
  DeviceKeys(gpu::Context& context, std::vector<Key> keys, unsigned bits);

  // One of our sorts, ready to run. model_bytes: bytes that it moves per key; 0 if there is no model.
  struct Sort {
    std::string name;
    Payload payload;
    double model_bytes;
    std::function<void()> launch;
  };
  Sort radix(Payload payload, SortForm form = SortForm::device);
  // The form for groups with another tuning than the device's.
  Sort radix(Payload payload, const RadixTuning& groups);
  Sort bitonic(Payload payload);

  // Brings the given keys and words back, as they are before each run.
  void restore();
  SortSeconds run(const Sort& sort);
  // Counts, for the last run, keys and values that differ from those of std::stable_sort. Above 2^22 keys it counts
  // keys out of order, values that do not belong to their keys or are not stable, and one more if the sum of the keys
  // changed.
  size_t wrong(const Sort& sort) const;

  // Keys and values after the last run; without payload no values.
  using Result = std::pair<std::vector<Key>, std::vector<uint32_t>>;
  Result result(const Sort& sort) const {
    return {sorted_.read(), sort.payload == Payload::none ? std::vector<uint32_t>() : values_.read()};
  }

  const std::vector<Key>& keys() const { return keys_; }

 private:
  gpu::Context& context_;
  std::vector<Key> keys_;
  unsigned bits_;
  gpu::Buffer<Key> given_, sorted_;
  gpu::Buffer<uint32_t> given_values_, values_;

  Sort radix(Payload payload, std::shared_ptr<RadixSort<Key>> sort, bool chunks);
  uint32_t count() const { return static_cast<uint32_t>(keys_.size()); }
  size_t wrong_by_stable_sort(const std::vector<Key>& keys, const std::vector<uint32_t>& places) const;
  size_t wrong_by_rules(const std::vector<Key>& keys, const std::vector<uint32_t>& places) const;
};

extern template class DeviceKeys<uint32_t>;
extern template class DeviceKeys<uint64_t>;

}  // namespace wavetracer::bench
