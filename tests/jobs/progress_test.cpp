// SPDX-License-Identifier: Apache-2.0
// Elapsed time, rate and time left, compared with a clock and a division.
#include "jobs/progress.hpp"
#include <doctest/doctest.h>
#include <fcntl.h>
#include <pty.h>
#include <unistd.h>
#include <chrono>
#include <string>
#include <thread>
#include "base/digits.hpp"

using wavetracer::grouped;
using wavetracer::Progress;
using wavetracer::progress_words;

namespace {

// Returns what `action` writes to stderr while that is a terminal.
template <class Action>
std::string on_terminal(const Action& action) {
  int master = -1, slave = -1;
  REQUIRE(openpty(&master, &slave, nullptr, nullptr, nullptr) == 0);
  const int before = dup(STDERR_FILENO);
  dup2(slave, STDERR_FILENO);
  action();
  dup2(before, STDERR_FILENO);
  fcntl(master, F_SETFL, O_NONBLOCK);
  std::string text;
  char part[4096];
  for (ssize_t count; (count = ::read(master, part, sizeof part)) > 0;) text.append(part, static_cast<size_t>(count));
  for (const int file : {master, slave, before}) close(file);
  return text;
}

void wait_for_next_bar() { std::this_thread::sleep_for(std::chrono::milliseconds(150)); }

}  // namespace

TEST_CASE("progress has the elapsed time, and once something is done a rate and the time left") {
  CHECK(progress_words(0, 0, 0, 10, "frames") == "elapsed 0:00");
  CHECK(progress_words(65, 0, 0, 10, "frames") == "elapsed 1:05");
  CHECK(progress_words(10, 0, 5, 20, "frames") == "elapsed 0:10, 0.5 frames/s, 0:30 left");
  CHECK(progress_words(10, 100, 105, 120, "frames") == "elapsed 0:10, 0.5 frames/s, 0:30 left");  // 100 were there
  CHECK(progress_words(14, 0, 8000, 178937000, {"rays", false}) == "elapsed 0:14, 571 rays/s");   // few take long each
  CHECK(progress_words(14, 0, 2000000, 178937000, {"rays", false}) == "elapsed 0:14, 143 krays/s, 20:39 left");
  CHECK(progress_words(3723, 0, 3723000000, 7446000000, "rays") == "elapsed 1:02:03, 1 Mrays/s, 1:02:03 left");
}

TEST_CASE("a terminal has a bar, which tells of a long step from within and goes at the end") {
  const std::string text = on_terminal([] {
    Progress progress;
    progress.within("nothing has begun");
    progress.bar("frame 3", 3, 10, "frames");
    wait_for_next_bar();
    progress.within("50% of its rays");
    wait_for_next_bar();
    progress.bar("frame 4", 4, 10, "frames");
    progress.bar("a single thing", 0, 1, "things");
    progress.within("of no bar");
  });
  CHECK(text.find("nothing has begun") == std::string::npos);
  CHECK(text.find("frame 3 [#########.....................] 3/10, elapsed 0:00") != std::string::npos);
  CHECK(text.find("frame 3, 50% of its rays [#########.....................] 3/10, elapsed 0:00") != std::string::npos);
  CHECK(text.find("frame 4 [############..................] 4/10, elapsed 0:00, ") != std::string::npos);
  CHECK(text.find("of no bar") == std::string::npos);
  CHECK(text.ends_with(" \r"));
}

TEST_CASE("a step without parts has no bar, and tells of itself from within") {
  const std::string text = on_terminal([] {
    Progress progress;
    progress.step("your own settings");
    wait_for_next_bar();
    progress.within("50% of its rays");
    progress.end();
  });
  CHECK(text.find("your own settings, 50% of its rays, elapsed 0:00") != std::string::npos);
  CHECK(text.find('[') == std::string::npos);
}

TEST_CASE("digits are grouped") {
  CHECK(grouped(0) == "0");
  CHECK(grouped(999) == "999");
  CHECK(grouped(1000) == "1,000");
  CHECK(grouped(1234567890) == "1,234,567,890");
}
