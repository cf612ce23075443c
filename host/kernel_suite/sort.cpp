// SPDX-License-Identifier: Apache-2.0
// The public face of the pass KeySort.
// The width of keys is known when the object is made, so it holds the sort of one of them.
#include "wavetracer/kernels/sort.hpp"

#include <fmt/format.h>

#include <variant>

#include "kernel_suite/state.hpp"
#include "passes/sort.hpp"

namespace wavetracer::kernels {

namespace {

constexpr const char* sort_name = "Sort";

using AnySort = std::variant<KeySort<uint32_t>, KeySort<uint64_t>>;

wavetracer::Payload pass_payload(Payload payload) {
  switch (payload) {
    case Payload::none:
      return wavetracer::Payload::none;
    case Payload::words:
      return wavetracer::Payload::words;
    case Payload::index:
      return wavetracer::Payload::index;
  }
  refuse(sort_name, "the payload is none, words or index");
}

wavetracer::SortMethod pass_method(SortMethod method) {
  switch (method) {
    case SortMethod::automatic:
      return wavetracer::SortMethod::automatic;
    case SortMethod::radix:
      return wavetracer::SortMethod::radix;
    case SortMethod::bitonic:
      return wavetracer::SortMethod::bitonic;
  }
  refuse(sort_name, "the method is automatic, radix or bitonic");
}

AnySort made_sort(gpu::Context& context, const SortOptions& options) {
  const wavetracer::Payload payload = pass_payload(options.payload);
  const wavetracer::SortMethod method = pass_method(options.method);
  if (options.key_bits == 32) return KeySort<uint32_t>(context, payload, method);
  if (options.key_bits == 64) return KeySort<uint64_t>(context, payload, method);
  refuse(sort_name, fmt::format("key_bits = {}: keys have 32 or 64 bits", options.key_bits));
}

}  // namespace

struct Sort::State : PassState {
  State(const Context& of, const SortOptions& with)
      : PassState(of), options(with), sort(made_sort(context->gpu, with)) {}
  SortOptions options;
  AnySort sort;
  gpu::Buffer<uint32_t> temporary;
  bool given = false;  // the temporary memory is the caller's

  size_t words(uint32_t n) const {
    return std::visit([&](const auto& of_key) { return of_key.temporary_words(n); }, sort);
  }
  // Makes temporary memory of its own large enough, or refuses the caller's.
  void make_room(uint32_t n) {
    const size_t needed = words(n);
    if (temporary.size() >= needed && temporary) return;
    if (given)
      refuse(sort_name, fmt::format("{} words of temporary memory were given, {} are needed for {} keys",
                                    temporary.size(), needed, n));
    temporary = context->gpu.buffer<uint32_t>(needed, "temporary memory of a sort");
  }

  template <class Key>
  void run(const Buffer<Key>& keys, const Buffer<uint32_t>* values, size_t n, BitRange bits, const Call& call) {
    auto* const of_key = std::get_if<KeySort<Key>>(&sort);
    if (!of_key)
      refuse(sort_name,
             fmt::format("it was made for keys of {} bits, those given have {}", options.key_bits, 8 * sizeof(Key)));
    if ((values == nullptr) != (options.payload == Payload::none))
      refuse(sort_name, values ? "it was made for Payload::none, and values were given"
                               : "it was made for a payload, and no values were given");
    const uint32_t count = count_of(sort_name, n);
    gpu::Buffer<Key> key = buffer_of(*this, sort_name, "keys", keys, n);
    gpu::Buffer<uint32_t> value;
    if (values) value = buffer_of(*this, sort_name, "values", *values, n);
    const unsigned end_bit = bits.end_bit == 0 ? options.key_bits : bits.end_bit;
    of_key->check_bits(bits.first_bit, end_bit);
    make_room(count);
    enqueue(*this, call, [&] {
      if (values)
        (*of_key)(key, value, count, temporary, bits.first_bit, end_bit);
      else
        (*of_key)(key, count, temporary, bits.first_bit, end_bit);
    });
  }
};

Sort::Sort(const Context& context, const SortOptions& options)
    : state_(with_errors([&] { return std::make_unique<State>(context, options); })) {}
Sort::~Sort() = default;
Sort::Sort(Sort&&) noexcept = default;
Sort& Sort::operator=(Sort&&) noexcept = default;

void Sort::operator()(const Buffer<uint32_t>& keys, const Buffer<uint32_t>& values, size_t n, BitRange bits,
                      const Call& call) {
  with_errors([&] { state_->run(keys, &values, n, bits, call); });
}
void Sort::operator()(const Buffer<uint64_t>& keys, const Buffer<uint32_t>& values, size_t n, BitRange bits,
                      const Call& call) {
  with_errors([&] { state_->run(keys, &values, n, bits, call); });
}
void Sort::operator()(const Buffer<uint32_t>& keys, size_t n, BitRange bits, const Call& call) {
  with_errors([&] { state_->run(keys, nullptr, n, bits, call); });
}
void Sort::operator()(const Buffer<uint64_t>& keys, size_t n, BitRange bits, const Call& call) {
  with_errors([&] { state_->run(keys, nullptr, n, bits, call); });
}

size_t Sort::temporary_words(size_t n) const { return state_->words(count_of(sort_name, n)); }

void Sort::reserve(size_t n) {
  with_errors([&] { state_->make_room(count_of(sort_name, n)); });
}

void Sort::use_temporary(const Buffer<uint32_t>& memory) {
  with_errors([&] {
    state_->given = static_cast<bool>(memory);
    state_->temporary =
        state_->given ? buffer_of(*state_, sort_name, "temporary memory", memory, 0) : gpu::Buffer<uint32_t>();
  });
}

size_t Sort::block() const {
  return std::visit([](const auto& of_key) { return size_t{of_key.block()}; }, state_->sort);
}

}  // namespace wavetracer::kernels
