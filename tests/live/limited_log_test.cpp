// SPDX-License-Identifier: Apache-2.0
// A log that clients cannot fill, against the lines that it must have.
#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <vector>

#include "live/limited_log.hpp"

namespace wavetracer::live {

TEST_CASE("so many lines of a second are logged, and the number of the others is said in the next one") {
  using namespace std::chrono_literals;
  std::vector<std::string> said;
  LimitedLog log([&](const std::string& line) { said.push_back(line); }, 2);
  const Clock::time_point begin{1h};
  log.catch_up(begin);
  log.finish();
  CHECK(said.empty());
  for (int k = 0; k < 5; ++k) log.say("line " + std::to_string(k), begin + k * 200ms);
  CHECK(said == std::vector<std::string>{"line 0", "line 1"});
  log.catch_up(begin + 999ms);
  CHECK(said.size() == 2);
  log.say("line 5", begin + 1s);
  REQUIRE(said.size() == 4);
  CHECK(said[2].starts_with("3 more lines about clients were left out"));
  CHECK(said[3] == "line 5");
  log.catch_up(begin + 5s);  // none was left out
  CHECK(said.size() == 4);
  for (int k = 6; k < 9; ++k) log.say("line " + std::to_string(k), begin + 5s);
  log.catch_up(begin + 6s);  // without a new line
  REQUIRE(said.size() == 7);
  CHECK(said[6].starts_with("1 more lines about clients were left out"));
  for (int k = 0; k < 4; ++k) log.say("last", begin + 7s);
  log.finish();
  REQUIRE(said.size() == 10);
  CHECK(said[9].starts_with("2 more lines"));
}

}  // namespace wavetracer::live
