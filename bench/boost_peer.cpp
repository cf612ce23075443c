// SPDX-License-Identifier: Apache-2.0
// Boost.Compute runs in its own context on the device of the same platform and name.
// It uses a radix sort on GPUs, a merge sort on CPUs. Its programs compile in the first run, which is not counted.
#include "boost_peer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/compute/algorithm/copy.hpp>
#include <boost/compute/algorithm/sort.hpp>
#include <boost/compute/algorithm/sort_by_key.hpp>
#include <boost/compute/container/vector.hpp>
#include <boost/compute/system.hpp>
#include <memory>
#include <numeric>

#include "timing.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

namespace compute = boost::compute;

template <class Key>
class BoostSort {
 public:
  BoostSort(const compute::device& device, const std::vector<Key>& keys, bool payload)
      : context_(device),
        queue_(context_, device),
        payload_(payload),
        given_(keys.begin(), keys.end(), queue_),
        keys_(keys.size(), context_),
        values_(payload ? keys.size() : 1, context_) {
    std::vector<compute::uint_> index(values_.size());
    std::iota(index.begin(), index.end(), 0u);
    given_values_ = compute::vector<compute::uint_>(index.begin(), index.end(), queue_);
  }

  double run() {
    compute::copy(given_.begin(), given_.end(), keys_.begin(), queue_);
    compute::copy(given_values_.begin(), given_values_.end(), values_.begin(), queue_);
    queue_.finish();
    const double seconds = wall_seconds([&] {
      if (payload_)
        compute::sort_by_key(keys_.begin(), keys_.end(), values_.begin(), queue_);
      else
        compute::sort(keys_.begin(), keys_.end(), queue_);
      queue_.finish();
    });
    std::vector<Key> result(keys_.size());
    compute::copy(keys_.begin(), keys_.end(), result.begin(), queue_);
    if (!std::is_sorted(result.begin(), result.end()))
      throw RuntimeError(fmt::format("Boost.Compute left {} keys unsorted", result.size()));
    return seconds;
  }

 private:
  compute::context context_;
  compute::command_queue queue_;
  bool payload_;
  compute::vector<Key> given_, keys_;
  compute::vector<compute::uint_> given_values_, values_;
};

compute::device find_device(const gpu::DeviceInfo& wanted) {
  for (const compute::device& device : compute::system::devices())
    if (device.name() == wanted.name && device.platform().name() == wanted.platform) return device;
  throw RuntimeError(fmt::format("Boost.Compute does not see {} of {}", wanted.name, wanted.platform));
}

}  // namespace

template <class Key>
SortPeer boost_peer(const gpu::DeviceInfo& device, const std::vector<Key>& keys, bool payload) {
  using Word = std::conditional_t<sizeof(Key) == 4, compute::uint_, compute::ulong_>;
  auto words = std::make_shared<const std::vector<Word>>(keys.begin(), keys.end());
  std::shared_ptr<BoostSort<Word>> sort;
  return {"Boost.Compute", [=]() mutable {
            try {
              if (!sort) sort = std::make_shared<BoostSort<Word>>(find_device(device), *words, payload);
              return sort->run();
            } catch (const compute::opencl_error& error) {
              throw RuntimeError(fmt::format("Boost.Compute on {}: {}", device.name, error.what()));
            }
          }};
}

template SortPeer boost_peer(const gpu::DeviceInfo&, const std::vector<uint32_t>&, bool);
template SortPeer boost_peer(const gpu::DeviceInfo&, const std::vector<uint64_t>&, bool);

}  // namespace wavetracer::bench
