// SPDX-License-Identifier: Apache-2.0
// Tests the first level of refined launches while launchers come and go: every cell is sampled once for each launcher,
// whatever was launched before, cold or warm.
#include "simulation/refinement.hpp"

#include <doctest/doctest.h>

#include "passes/on_device.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint32_t most_launchers = 16;

std::vector<Launcher> some_launchers(uint32_t count) {
  std::vector<Launcher> out;
  for (uint32_t i = 0; i < count; ++i) out.push_back({i, {1.0 * i, 2, 3}});
  return out;
}

// Counts samples that are not (cell i % cells, launcher i / cells), plus 1 if there are too few or too many.
size_t wrong_samples(const SampleList& list, uint32_t launchers) {
  if (list.count != list.cells() * launchers) return 1;
  const std::vector<uint32_t> cell = list.samples.read(0, list.count);
  const std::vector<uint32_t> launcher = list.samples.read(list.capacity, list.count);
  size_t wrong = 0;
  for (uint32_t i = 0; i < list.count; ++i) wrong += cell[i] != i % list.cells() || launcher[i] != i / list.cells();
  return wrong;
}

}  // namespace

TEST_CASE("from any number of launchers to any other, cold and warm, both ways: the cells of a fresh launch") {
  Refinement refinement(context(), TraceConfig{}, std::make_shared<LaunchHeights>(context()));
  size_t cold_cells = 0, warm_cells = 0;
  for (uint32_t before = 1; before <= most_launchers; ++before)
    for (uint32_t after = before; after <= most_launchers; ++after)
      for (const auto& [first, then] : {std::pair{0u, 1u}, {1u, 0u}, {0u, 0u}, {1u, 1u}}) {
        CAPTURE(before);
        CAPTURE(after);
        CAPTURE(first);
        CAPTURE(then);
        for (const auto& [launchers, frame] : {std::pair{before, first}, {after, then}, {before, first}}) {
          refinement.start(some_launchers(launchers), 1024, frame);
          CHECK(wrong_samples(refinement.level(), launchers) == 0);
          (frame == 0 ? cold_cells : warm_cells) = refinement.level().cells();
        }
      }
  CHECK(cold_cells == 16 * warm_cells);  // so that 16 launchers have as many samples as one
}

TEST_CASE("on hills a launch begins one level finer, and two where more than 0.99 of the paths are wanted") {
  const auto cells = [](bool hilly, double recall, uint32_t frame) {
    TraceConfig trace;
    trace.recall = recall;
    Refinement refinement(context(), trace, std::make_shared<LaunchHeights>(context()), hilly);
    refinement.start(some_launchers(1), 1024, frame);
    return refinement.level().cells();
  };
  for (const uint32_t frame : {0u, 1u}) {
    CHECK(cells(true, 0.99, frame) == 4 * cells(false, 0.99, frame));
    CHECK(cells(true, 0.999, frame) == 16 * cells(false, 0.999, frame));
    CHECK(cells(false, 0.999, frame) == cells(false, 0.99, frame));
  }
}
