// A slot for a job, a slot for its answer, and an eventfd that wakes poll().
// Errors of poses are the client's; those of the device end the server.
#include "live/solver.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include "live/answer.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::live {

Solver::Solver(Simulation& simulation) : simulation_(simulation), event_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (*event_ < 0) throw RuntimeError("no file descriptor is left for the solver's thread: raise ulimit -n");
  thread_ = std::thread([this] { run(); });
}

Solver::~Solver() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Solver::give(Job job) {
  busy_ = true;
  {
    const std::lock_guard lock(mutex_);
    job_ = std::move(job);
  }
  wake_.notify_one();
}

std::optional<Answer> Solver::take() {
  uint64_t ignored = 0;
  if (read(*event_, &ignored, sizeof ignored) < 0) return {};
  const std::lock_guard lock(mutex_);
  busy_ = false;
  return std::exchange(answer_, std::nullopt);
}

void Solver::run() {
  while (true) {
    std::optional<Job> job;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return ends_ || job_; });
      if (ends_) return;
      job = std::exchange(job_, std::nullopt);
    }
    Answer answer = solve(*job);
    const std::lock_guard lock(mutex_);
    answer_ = std::move(answer);
    const uint64_t one = 1;
    [[maybe_unused]] const ssize_t written = write(*event_, &one, sizeof one);  // cannot block: it is at 0 or 1
  }
}

Answer Solver::solve(const Job& job) {
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  const FrameMessage& message = job.message;
  const auto error = [&](std::string_view code, const std::string& text, bool fatal) {
    return Answer{job.client, error_line(code, text, message.frame, fatal), fatal};
  };
  try {
    const Clock::time_point start = Clock::now();
    if (message.cold) simulation_.forget();
    const LiveFrame frame = simulation_.run_poses(*job.traffic, message.time_s, message.vehicles);
    const FrameTimes times{seconds(start - job.received), seconds(Clock::now() - start)};
    return {job.client, channels_line(message, frame, job.detail, job.skipped, times)};
  } catch (const PoseError& e) {
    return error(e.code, e.what(), false);
  } catch (const std::exception& e) {
    return error("server", e.what(), true);
  }
}

}  // namespace wavetracer::live
