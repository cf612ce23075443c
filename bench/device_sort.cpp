// SPDX-License-Identifier: Apache-2.0
// Runs and checks our sorts.
// The word that travels with key i is ~i, so that a sort that made up its own indices would be detected.
#include "device_sort.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

#include "passes/bitonic_sort.hpp"
#include "timing.hpp"

namespace wavetracer::bench {
namespace {

constexpr size_t most_to_sort_on_host = size_t{1} << 22;

std::vector<uint32_t> travelling_words(size_t n) {
  std::vector<uint32_t> words(n);
  for (size_t i = 0; i < n; i++) words[i] = ~static_cast<uint32_t>(i);
  return words;
}

// The keys are read once to count all digits, or by chunks once for each; a pass of eight bits reads and writes keys
// and words (A. Adinets and D. Merrill, "Onesweep", arXiv 2206.01784). Indices are not read before the first pass.
template <class Key>
double radix_bytes(Payload payload, unsigned bits, bool chunks) {
  const unsigned passes = (bits + 7) / 8, word = payload == Payload::none ? 0 : 4, counted = chunks ? passes : 1;
  return passes * 2.0 * (sizeof(Key) + word) + counted * sizeof(Key) - (payload == Payload::index ? word : 0);
}

}  // namespace

template <class Key>
DeviceKeys<Key>::DeviceKeys(gpu::Context& context, std::vector<Key> keys, unsigned bits)
    : context_(context),
      keys_(std::move(keys)),
      bits_(bits),
      given_(context.buffer(keys_, "given keys")),
      sorted_(context.buffer<Key>(keys_.size(), "keys")),
      given_values_(context.buffer(travelling_words(keys_.size()), "given values")),
      values_(context.buffer<uint32_t>(keys_.size(), "values")) {}

template <class Key>
typename DeviceKeys<Key>::Sort DeviceKeys<Key>::radix(Payload payload, SortForm form) {
  const bool chunks = form == SortForm::device ? tuning_of(context_.info()).alone : form != SortForm::groups;
  return radix(payload, std::make_shared<RadixSort<Key>>(context_, payload, form), chunks);
}

template <class Key>
typename DeviceKeys<Key>::Sort DeviceKeys<Key>::radix(Payload payload, const RadixTuning& groups) {
  return radix(payload, std::make_shared<RadixSort<Key>>(context_, payload, groups), false);
}

template <class Key>
typename DeviceKeys<Key>::Sort DeviceKeys<Key>::radix(Payload payload, std::shared_ptr<RadixSort<Key>> sort,
                                                      bool chunks) {
  auto temporary = context_.buffer<uint32_t>(sort->temporary_words(count()), "temporary");
  return {"radix", payload, radix_bytes<Key>(payload, bits_, chunks), [this, sort, temporary, payload]() mutable {
            if (payload == Payload::none)
              (*sort)(sorted_, count(), temporary, 0, bits_);
            else
              (*sort)(sorted_, values_, count(), temporary, 0, bits_);
          }};
}

template <class Key>
typename DeviceKeys<Key>::Sort DeviceKeys<Key>::bitonic(Payload payload) {
  const auto sort = std::make_shared<BitonicSort<Key>>(context_, payload);
  auto temporary = context_.buffer<uint32_t>(std::max<size_t>(sort->temporary_words(count()), 1), "temporary");
  return {"bitonic", payload, 0, [this, sort, temporary, payload]() mutable {
            if (payload == Payload::none)
              (*sort)(sorted_, count(), temporary);
            else
              (*sort)(sorted_, values_, count(), temporary);
          }};
}

template <class Key>
void DeviceKeys<Key>::restore() {
  context_.copy(given_, sorted_, given_.bytes());
  context_.copy(given_values_, values_, given_values_.bytes());
}

template <class Key>
SortSeconds DeviceKeys<Key>::run(const Sort& sort) {
  const auto once = [&](bool profiling) {
    context_.set_profiling(profiling);
    restore();
    context_.finish();
    context_.reset_profile();
    return wall_seconds([&] {
      sort.launch();
      context_.finish();
    });
  };
  const double wall = once(false);
  once(true);
  return {wall, device_seconds(context_)};
}

template <class Key>
size_t DeviceKeys<Key>::wrong(const Sort& sort) const {
  const std::vector<Key> keys = sorted_.read();
  std::vector<uint32_t> places;  // original place of each key; empty without payload
  if (sort.payload != Payload::none) places = values_.read();
  if (sort.payload == Payload::words)
    for (uint32_t& place : places) place = ~place;
  return keys_.size() <= most_to_sort_on_host ? wrong_by_stable_sort(keys, places) : wrong_by_rules(keys, places);
}

template <class Key>
size_t DeviceKeys<Key>::wrong_by_stable_sort(const std::vector<Key>& keys, const std::vector<uint32_t>& places) const {
  std::vector<std::pair<Key, uint32_t>> expected(keys_.size());
  for (uint32_t i = 0; i < count(); i++) expected[i] = {keys_[i], i};
  std::stable_sort(expected.begin(), expected.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  size_t differing = 0;
  for (size_t i = 0; i < expected.size(); i++)
    differing += keys[i] != expected[i].first || (!places.empty() && places[i] != expected[i].second);
  return differing;
}

// With places, these rules allow only the result of a stable sort: places that ascend among equal keys are distinct.
template <class Key>
size_t DeviceKeys<Key>::wrong_by_rules(const std::vector<Key>& keys, const std::vector<uint32_t>& places) const {
  size_t violations = 0;
  for (size_t i = 0; i < keys.size(); i++) {
    bool right = i == 0 || keys[i - 1] <= keys[i];
    if (!places.empty()) {
      right = right && places[i] < keys_.size() && keys_[places[i]] == keys[i];
      right = right && (i == 0 || keys[i - 1] != keys[i] || places[i - 1] < places[i]);
    }
    violations += !right;
  }
  const auto sum = [](const std::vector<Key>& all) { return std::accumulate(all.begin(), all.end(), uint64_t{0}); };
  return violations + (sum(keys) != sum(keys_));
}

template class DeviceKeys<uint32_t>;
template class DeviceKeys<uint64_t>;

}  // namespace wavetracer::bench
