// SPDX-License-Identifier: Apache-2.0
#include "base/aligned_text.hpp"

#include <doctest/doctest.h>

TEST_CASE("columns are as wide as their widest cells, and lines end with no blank") {
  CHECK(wavetracer::aligned_text({{"a", "long", "x"}, {"wide", "b", ""}, {"", "", "end"}}) ==
        "a     long  x\nwide  b\n            end\n");
  CHECK(wavetracer::aligned_text({{"one"}, {"1", "2"}}) == "one\n1    2\n");
  CHECK(wavetracer::aligned_text({}).empty());
}
