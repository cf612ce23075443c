// SPDX-License-Identifier: Apache-2.0
// Solves one frame at a time on its own thread, for the client that the server chooses, and turns every failure into an
// answer. Jobs are given and taken by one thread, that of the sockets; no other thread may use the simulation
// meanwhile.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "live/message.hpp"
#include "live/worker.hpp"
#include "wavetracer/live.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::live {

using Clock = std::chrono::steady_clock;

struct Job {
  uint64_t client = 0;
  FrameMessage message;
  Detail detail = Detail::links;
  Encoding encoding = Encoding::json;
  RadarDetail radar = RadarDetail::none;
  uint64_t skipped = 0;
  Clock::time_point received;
  std::shared_ptr<LiveTraffic> traffic;  // the client's
};

// An answer that cannot be given, though its frame was computed; the client is told why.
struct AnswerError : std::runtime_error {
  std::string code;  // too_large
  AnswerError(std::string error_code, const std::string& message)
      : std::runtime_error(message), code(std::move(error_code)) {}
};

struct Answer {
  uint64_t client = 0;
  std::string line;     // the answer, and the bytes that follow it
  std::string failure;  // text for the log; empty if the frame was solved or the client's poses were wrong
  bool fatal = false;   // the device failed, which ends the server
  uint64_t untold = 0;  // skipped frames before this one, if the line does not mention them
};

// Solves a job and returns the answer. afresh: results of earlier frames must not be used. Throws PoseError if the
// poses are wrong, AnswerError if the answer is refused, DeviceError if the device has failed, any other exception if
// only this frame failed.
using Solve = std::function<std::string(const Job& job, bool afresh)>;
// solved: called for every frame before it is answered; must not throw; may be empty.
using FrameSolved = std::function<void(const Simulation&, const LiveFrame&)>;
Solve solve_with(Simulation& simulation, FrameSolved solved = {});

class Solver {
 public:
  explicit Solver(Solve solve);

  // From give() to take() there is at most one job.
  bool idle() const { return !busy_; }
  void give(Job job);
  // Returns a descriptor that is readable once an answer is ready.
  int descriptor() const { return worker_.descriptor(); }
  std::optional<Answer> take();

 private:
  Answer answer(const Job& job);

  Solve solve_;
  bool afresh_ = false;  // used by the worker's thread: the frame before failed midway
  bool busy_ = false;    // used by the giver's thread
  Worker<Job, Answer> worker_;
};

}  // namespace wavetracer::live
