// SPDX-License-Identifier: Apache-2.0
// Runs mixed operations as a test, see cache_mixed.hpp.
// It uses the context of on_device.hpp.
#pragma once
#include <doctest/doctest.h>

#include "passes/cache_mixed.hpp"

namespace wavetracer::test {

// crowded: all work-items use a few keys. On a GPU thousands of them meet at each, and hardly any succeeds.
inline void check_mixed(const TableKind& kind, uint64_t operations, uint64_t entries, double load,
                        bool crowded = false) {
  CAPTURE(kind.name());
  CAPTURE(load);
  const MixedReport report = run_mixed(context(), kind, operations, entries, load);
  CHECK(report.faults.wrong_answers == 0);
  CHECK(report.faults.never_put == 0);
  CHECK(report.faults.lost == 0);
  CHECK(report.faults.miscounted == 0);
  CHECK(report.hits > (crowded ? 100 : operations / 50));
  if (kind.key == "quantised") CHECK(report.replaced > (crowded ? 100 : report.puts / 10));
}

}  // namespace wavetracer::test
