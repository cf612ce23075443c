// Lists that kernels append to, counting: run, ask for the length, and where the list was too small make it larger and
// run again. Assumes that a kernel counts on beyond the capacity, and writes nothing there.
#pragma once
#include "passes/counters.hpp"

namespace wavetracer {

// run(): the kernel; length(): what it has counted; capacity(): of the list now; grow(n): makes room for n elements,
// and lets the counter begin again with what the list still holds. Returns the length of the list.
template <class Run, class Length, class Capacity, class Grow>
uint32_t grow_until_filled(const Run& run, const Length& length, const Capacity& capacity, const Grow& grow) {
  for (;;) {
    run();
    const uint32_t now = length();
    if (now <= capacity()) return now;
    grow(size_t{now} + now / 4);
  }
}

// The same for a list whose length is one of the counters of the frame; when it grows it begins with `kept` elements.
// Where lengths are foreseen the list is taken as it is, and this is a bound of its length.
template <class Capacity, class Run, class Grow>
uint32_t fill_list(Counters& counters, Counters::Count count, const char* stage, const Capacity& capacity,
                   const Run& run, const Grow& grow, uint32_t kept = 0) {
  return grow_until_filled(
      run, [&] { return counters.length(count, capacity(), stage); }, capacity,
      [&](size_t elements) {
        grow(elements);
        counters.restart(count, kept, stage);
      });
}

}  // namespace wavetracer
