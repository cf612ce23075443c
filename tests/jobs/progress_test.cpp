// Elapsed time, rate and time left, against what a clock and a division say.
#include "jobs/progress.hpp"
#include <doctest/doctest.h>
#include "base/digits.hpp"

using wavetracer::grouped;
using wavetracer::progress_words;

TEST_CASE("progress has the elapsed time, and once something is done a rate and the time left") {
  CHECK(progress_words(0, 0, 0, 10, "frames") == "elapsed 0:00");
  CHECK(progress_words(65, 0, 0, 10, "frames") == "elapsed 1:05");
  CHECK(progress_words(10, 0, 5, 20, "frames") == "elapsed 0:10, 0.5 frames/s, 0:30 left");
  CHECK(progress_words(10, 100, 105, 120, "frames") == "elapsed 0:10, 0.5 frames/s, 0:30 left");  // 100 were there
  CHECK(progress_words(3723, 0, 3723000000, 7446000000, "rays") == "elapsed 1:02:03, 1 Mrays/s, 1:02:03 left");
}

TEST_CASE("digits are grouped") {
  CHECK(grouped(0) == "0");
  CHECK(grouped(999) == "999");
  CHECK(grouped(1000) == "1,000");
  CHECK(grouped(1234567890) == "1,234,567,890");
}
