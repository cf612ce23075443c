// SPDX-License-Identifier: Apache-2.0
// The C interface from several threads and in forked processes, as wavetracer.h says: turns, observers, and the rights
// of a forked process.
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "wavetracer/wavetracer.h"

namespace {

const char* const config =
    "[scene]\ngenerate = \"--seed 1 --blocks 2x2\"\n[[transmitter]]\nname = \"t\"\nposition_m = [8, 8, 12]\n"
    "[[receiver]]\nname = \"r\"\nposition_m = [40, 3, 1.5]\n[trace]\nrays = 20000\nmax_depth = 3\n";

wavetracer_simulation* opened() {
  wavetracer_error* error = nullptr;
  wavetracer_simulation* const out = wavetracer_open(config, nullptr, nullptr, 0, "", &error);
  REQUIRE_MESSAGE(out != nullptr, wavetracer_error_message(error));
  return out;
}

std::vector<double> delays(const wavetracer_frame* frame) {
  wavetracer_column column{};
  if (wavetracer_frame_column(frame, "delay_s", &column, nullptr) != 1) return {};
  const auto* const first = static_cast<const double*>(column.data);
  return {first, first + column.rows};
}

// Returns the delays of a frame that is solved now; none if that fails.
std::vector<double> solved(wavetracer_simulation* simulation) {
  wavetracer_frame* const frame = wavetracer_run_frame(simulation, 0, nullptr);
  std::vector<double> out = delays(frame);
  wavetracer_frame_free(frame);
  return out;
}

// Returns the code of an error, which is freed; its text must contain this part.
int code_of(wavetracer_error* error, const char* part) {
  const int code = wavetracer_error_code(error);
  const bool says = std::string(wavetracer_error_message(error)).find(part) != std::string::npos;
  wavetracer_error_free(error);
  return says ? code : -1;
}

void run_threads(unsigned count, const std::function<void()>& body) {
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < count; ++i) threads.emplace_back(body);
  for (std::thread& thread : threads) thread.join();
}

// Returns how a forked process that does this ends; one that hangs is killed after half a minute.
int forked(const std::function<int()>& body, bool at_once) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGALRM, SIG_DFL);
    alarm(30);
    const int code = body();
    if (at_once) _exit(code);
    std::exit(code);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

}  // namespace

TEST_CASE("threads that solve frames of one simulation take turns, and each gets the frame") {
  wavetracer_simulation* const simulation = opened();
  const std::vector<double> alone = solved(simulation);
  REQUIRE(alone.size() > 2);
  std::atomic<int> wrong = 0, calls = 0;
  const wavetracer_observer count = [](void* user, const char*, uint64_t, uint64_t) {
    ++*static_cast<std::atomic<int>*>(user);
    return 1;
  };
  run_threads(4, [&] {
    for (int i = 0; i < 5; ++i) {
      wavetracer_observe(simulation, i % 2 == 0 ? count : nullptr, &calls);
      wavetracer_forget(simulation);
      if (solved(simulation) != alone) ++wrong;
      if (wavetracer_frame_count(simulation) != 1) ++wrong;
    }
  });
  CHECK(wrong == 0);
  CHECK(calls > 0);
  wavetracer_close(simulation);
}

TEST_CASE("threads with simulations of their own do not disturb each other, nor do those that write") {
  wavetracer_simulation* const first = opened();
  const std::vector<double> alone = solved(first);
  std::atomic<int> wrong = 0, number = 0;
  char name[] = "/tmp/wavetracer-threads-XXXXXX";
  REQUIRE(mkdtemp(name) != nullptr);
  const std::string folder = name;
  run_threads(3, [&] {
    wavetracer_simulation* const own = wavetracer_open(config, nullptr, nullptr, 0, nullptr, nullptr);
    wavetracer_frame* const frame = wavetracer_run_frame(own, 0, nullptr);
    const wavetracer_frame* const frames[] = {frame};
    const std::string to = folder + "/" + std::to_string(++number);
    if (!own || delays(frame) != alone || wavetracer_write(own, to.c_str(), frames, 1, nullptr) != 1) ++wrong;
    wavetracer_close(own);
    wavetracer_frame_free(frame);
  });
  CHECK(wrong == 0);
  wavetracer_close(first);
  CHECK(std::system(("rm -r " + folder).c_str()) == 0);
}

TEST_CASE("an observer cannot solve, write or close, and may forget and change who observes") {
  struct Watch {
    wavetracer_simulation* simulation;
    int frame_code = 0, write_code = 0, calls = 0, later = 0;
  } watch{opened()};
  const wavetracer_observer after = [](void* user, const char*, uint64_t, uint64_t) {
    ++static_cast<Watch*>(user)->later;
    return 1;
  };
  static const wavetracer_observer next = after;
  wavetracer_observe(
      watch.simulation,
      [](void* user, const char*, uint64_t, uint64_t) {
        Watch& w = *static_cast<Watch*>(user);
        ++w.calls;
        wavetracer_error* error = nullptr;
        wavetracer_run_frame(w.simulation, 0, &error);
        w.frame_code = code_of(error, "solving a frame");
        wavetracer_write(w.simulation, "/tmp", nullptr, 1, &error);
        w.write_code = code_of(error, "solving a frame");
        wavetracer_close(w.simulation);
        wavetracer_forget(w.simulation);
        wavetracer_observe(w.simulation, next, user);
        return 1;
      },
      &watch);
  CHECK(solved(watch.simulation).size() > 2);
  CHECK(watch.calls == 1);
  CHECK(watch.later > 0);
  CHECK(watch.frame_code == WAVETRACER_USAGE);
  CHECK(watch.write_code == WAVETRACER_USAGE);
  CHECK(solved(watch.simulation).size() > 2);
  wavetracer_close(watch.simulation);
}

TEST_CASE("a forked process reads frames, is told why it cannot solve any, and ends") {
  wavetracer_simulation* const simulation = opened();
  wavetracer_frame* const frame = wavetracer_run_frame(simulation, 0, nullptr);
  const std::vector<double> alone = delays(frame);
  for (const bool at_once : {true, false}) {
    const int ended = forked(
        [&] {
          wavetracer_error* error = nullptr;
          if (delays(frame) != alone) return 1;
          if (wavetracer_run_frame(simulation, 0, &error) || code_of(error, "\"spawn\"") != WAVETRACER_RUNTIME)
            return 2;
          if (wavetracer_open(config, nullptr, nullptr, 0, "", &error) ||
              code_of(error, "\"spawn\"") != WAVETRACER_RUNTIME)
            return 3;
          if (wavetracer_devices(&error) || code_of(error, "\"spawn\"") != WAVETRACER_RUNTIME) return 4;
          const wavetracer_frame* const frames[] = {frame};
          if (wavetracer_write(simulation, "/tmp", frames, 1, &error) ||
              code_of(error, "\"spawn\"") != WAVETRACER_RUNTIME)
            return 5;
          wavetracer_frame_free(frame);
          wavetracer_close(simulation);
          return 0;
        },
        at_once);
    CHECK(ended == 0);
  }
  CHECK(solved(simulation) == alone);
  wavetracer_frame_free(frame);
  wavetracer_close(simulation);
}
