// Solves one frame at a time on a thread of its own, from whichever client the server says, and makes every failure an
// answer. Assumes one giver and taker of jobs, the thread of the sockets; what solves is used on no other thread
// meanwhile.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

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
  uint64_t skipped = 0;
  Clock::time_point received;
  std::shared_ptr<LiveTraffic> traffic;  // of the client
};

struct Answer {
  uint64_t client = 0;
  std::string line;     // and the bytes that follow it
  std::string failure;  // what the log is told, empty where the frame was solved or the client's poses were wrong
  bool fatal = false;   // of the server: the device failed
  uint64_t untold = 0;  // frames that were skipped before this one, where the line does not say so
};

// The answer to a job. afresh: nothing of earlier frames is to be relied upon. Throws PoseError where the poses are
// wrong, DeviceError where the device is of no use any more, anything else where this one frame failed.
using Solve = std::function<std::string(const Job& job, bool afresh)>;
// solved: told of every frame before it is answered; must not throw; may be empty.
using FrameSolved = std::function<void(const Simulation&, const LiveFrame&)>;
Solve solve_with(Simulation& simulation, FrameSolved solved = {});

class Solver {
 public:
  explicit Solver(Solve solve);

  // From give() to take() there is one job at most.
  bool idle() const { return !busy_; }
  void give(Job job);
  // Readable once an answer is there.
  int descriptor() const { return worker_.descriptor(); }
  std::optional<Answer> take();

 private:
  Answer answer(const Job& job);

  Solve solve_;
  bool afresh_ = false;  // of the worker's thread: the frame before failed in the middle
  bool busy_ = false;    // of the giver's thread
  Worker<Job, Answer> worker_;
};

}  // namespace wavetracer::live
