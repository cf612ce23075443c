// The thread that solves: one frame at a time, from whichever client the server says.
// Assumes one giver and taker of jobs, the thread of the sockets. The simulation is used on no other thread meanwhile.
#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "live/endpoint.hpp"
#include "live/message.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::live {

using Clock = std::chrono::steady_clock;

struct Job {
  uint64_t client = 0;
  FrameMessage message;
  Detail detail = Detail::links;
  uint64_t skipped = 0;
  Clock::time_point received;
  std::shared_ptr<LiveTraffic> traffic;  // of the client
};

struct Answer {
  uint64_t client = 0;
  std::string line;
  bool fatal = false;  // of the server: the device failed
};

class Solver {
 public:
  explicit Solver(Simulation& simulation);
  ~Solver();  // ends after the frame that it is at
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  // From give() to take() there is one job at most.
  bool idle() const { return !busy_; }
  void give(Job job);
  // Readable once an answer is there.
  int descriptor() const { return *event_; }
  std::optional<Answer> take();

 private:
  void run();
  Answer solve(const Job& job);

  Simulation& simulation_;
  Descriptor event_;
  bool busy_ = false;  // of the giver's thread alone
  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Job> job_;
  std::optional<Answer> answer_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace wavetracer::live
