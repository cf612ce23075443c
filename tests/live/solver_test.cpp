// SPDX-License-Identifier: Apache-2.0
// An error while a frame is solved costs its client, that frame, or the server. Nothing is solved here.
#include "live/solver.hpp"

#include <doctest/doctest.h>
#include <poll.h>

#include <new>
#include <nlohmann/json.hpp>

#include "wavetracer/error.hpp"
#include "wavetracer/live.hpp"

using namespace wavetracer;
using namespace wavetracer::live;

namespace {

// The answer to one frame of client 7; waits for it as the server does.
Answer ask(Solver& solver, uint64_t frame) {
  solver.give({.client = 7,
               .message = {.frame = frame, .time_s = 0, .vehicles = {}, .cold = false, .detail = {}},
               .detail = Detail::links,
               .skipped = 0,
               .received = {},
               .traffic = {}});
  CHECK(!solver.idle());
  pollfd ready{solver.descriptor(), POLLIN, 0};
  REQUIRE(poll(&ready, 1, 10000) == 1);
  const std::optional<Answer> answer = solver.take();
  REQUIRE(answer);
  CHECK(solver.idle());
  CHECK(!solver.take());
  CHECK(answer->client == 7);
  return *answer;
}

// The error that a frame is answered with where solving it throws this.
template <class Error>
std::pair<Answer, nlohmann::json> failed(const Error& thrown) {
  Solver solver([&](const Job&, bool) -> std::string { throw thrown; });
  const Answer answer = ask(solver, 5);
  const nlohmann::json line = nlohmann::json::parse(answer.line);
  CHECK(line["message"] == "error");
  CHECK(line["frame"] == 5);
  CHECK(line["fatal"] == answer.fatal);
  return {answer, line};
}

}  // namespace

TEST_CASE("poses are the client's fault, a frame that fails costs that frame, and only the device ends the server") {
  const auto [pose, pose_line] = failed(PoseError("no_place", "all are taken"));
  CHECK(pose_line["code"] == "no_place");
  CHECK(!pose.fatal);
  CHECK(pose.failure.empty());
  const auto check_failed = [](const auto& answer) {
    const auto& [made, line] = answer;
    CHECK(line["code"] == "failed");
    CHECK(!made.fatal);
    CHECK(!made.failure.empty());
  };
  check_failed(failed(RuntimeError("a limit is met")));
  check_failed(failed(ConfigError("a contradiction")));
  check_failed(failed(InputError("a broken file")));
  check_failed(failed(std::out_of_range("a number too far")));
  check_failed(failed(std::bad_alloc()));
  const auto [device, device_line] = failed(DeviceError("the device is gone"));
  CHECK(device_line["code"] == "server");
  CHECK(device.fatal);
  CHECK(device.failure == "the device is gone");
}

TEST_CASE("after a frame that failed nothing of earlier ones is relied upon, until one succeeds") {
  std::vector<bool> afresh;
  Solver solver([&](const Job& job, bool now) -> std::string {
    afresh.push_back(now);
    if (job.message.frame == 1 || job.message.frame == 2) throw std::runtime_error("in the middle");
    if (job.message.frame == 3) throw PoseError("duplicate_id", "before anything began");
    return "solved\n";
  });
  for (uint64_t frame = 0; frame < 6; ++frame) {
    const Answer answer = ask(solver, frame);
    CHECK((answer.line == "solved\n") == (frame == 0 || frame > 3));
  }
  CHECK(afresh == std::vector<bool>{false, false, true, true, true, false});
}
