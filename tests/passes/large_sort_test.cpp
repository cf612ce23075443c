// SPDX-License-Identifier: Apache-2.0
// radix_sort with more keys than Oclgrind can handle: millions of keys, which fill every chunk and more than a cache.
// The first case has more tiles than chunks, so that chunks hold several. The small cases are in radix_sort_test.cpp.
#include "passes/sort_cases.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("radix sort: millions of keys") {
  for (const NamedForm& form : sort_forms) {
    CAPTURE(form.name);
    RadixSort<uint32_t> words(context(), Payload::words, form.form);
    check_sort<uint32_t>(words, Payload::words, {random_keys<uint32_t>(5000001, 1)});
    RadixSort<uint64_t> index(context(), Payload::index, form.form);
    check_sort<uint64_t>(index, Payload::index, {random_keys<uint64_t>((1u << 22) - 1, 2)});
    RadixSort<uint32_t> none(context(), Payload::none, form.form);
    check_sort<uint32_t>(none, Payload::none, {random_keys<uint32_t>(1u << 22, 3, 0x00FFF00Fu)});
  }
}
