// SPDX-License-Identifier: Apache-2.0
// --frames: every form, and every mistake with its advice.
// Neither the program nor a device is needed.
#include "jobs/frame_range.hpp"
#include <doctest/doctest.h>
#include <utility>
#include "wavetracer/error.hpp"

using namespace wavetracer;

TEST_CASE("ranges include both ends, and an end that is left out is that of the run") {
  const auto range = [](const char* text) {
    const FrameRange frames = parse_frames(text, 60);
    return std::pair{frames.first, frames.last};
  };
  CHECK(range("") == std::pair{0u, 59u});
  CHECK(range("5:17") == std::pair{5u, 17u});
  CHECK(range("5:") == std::pair{5u, 59u});
  CHECK(range(":17") == std::pair{0u, 17u});
  CHECK(range("7") == std::pair{7u, 7u});
  CHECK(range("59:59") == std::pair{59u, 59u});
  CHECK(parse_frames("5:17", 60).count() == 13);
  CHECK(parse_frames("", uint64_t{1} << 32).count() == uint64_t{1} << 32);
}

TEST_CASE("mistakes say how many frames there are") {
  const auto check = [](const char* text, uint64_t count, const char* message) {
    CAPTURE(text);
    CHECK_THROWS_WITH_AS(parse_frames(text, count), doctest::Contains(message), ConfigError);
  };
  check("0:60", 60, "--frames 0:60: this run has 60 frames, 0 to 59");
  check("60", 60, "this run has 60 frames");
  check("9:3", 60, "did you mean 3:9?");
  for (const char* text : {":", "a:3", "1:2:3", "-1:3", "1.5", "99999999999", " 1:2", "1: 2", "0x1"})
    check(text, 60, "give the first and the last frame as A:B, A:, :B or A; this run has 60 frames");
  check("0:1", 1, "frame 0 only");
}

TEST_CASE("what is wrong for any number of frames is refused without it") {
  for (const char* text : {"", "3", "2:", ":7", "3:3", "3:9"}) CHECK_NOTHROW(check_frames(text));
  CHECK_THROWS_WITH_AS(check_frames("9:3"), doctest::Contains("did you mean 3:9?"), ConfigError);
  CHECK_THROWS_WITH_AS(check_frames("a:3"), doctest::Contains("give the first and the last frame"), ConfigError);
}
