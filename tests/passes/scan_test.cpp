// scan: exclusive prefix sums against the standard library's, for counts around the work-group's size and far above.
// The longest has more elements than any batch has blocks on a small device.
#include "passes/scan.hpp"

#include <doctest/doctest.h>

#include <numeric>
#include <vector>

#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("exclusive sums in place, and their total") {
  Scan scan(context());
  Random random(1);
  for (const uint32_t count : {0u, 1u, 2u, 15u, 16u, 17u, 1000u, 1023u, 1024u, 1025u, 100000u}) {
    CAPTURE(count);
    std::vector<uint32_t> values(count + 3, 7);  // what lies behind must stay
    for (uint32_t i = 0; i < count; ++i) values[i] = random.below(17);
    std::vector<uint32_t> expected = values;
    std::exclusive_scan(values.begin(), values.begin() + count, expected.begin(), 0u);
    gpu::Buffer<uint32_t> buffer = context().buffer(values, "counts");
    CHECK(scan(buffer, count) == std::accumulate(values.begin(), values.begin() + count, 0u));
    CHECK(buffer.read() == expected);
  }
}
