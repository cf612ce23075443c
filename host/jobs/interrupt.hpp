// Ctrl-C: the first one asks the run to stop after what it is doing, the second one stops it at once.
// One process has one such request; it is never taken back.
#pragma once
#include <signal.h>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

namespace wavetracer {

// From now on SIGINT and SIGTERM only raise the request. acknowledge: and say so on stderr, at once.
void catch_interrupts(bool acknowledge = true);
bool interrupted();

// While it lives, SIGINT and SIGTERM go to a thread of its own, which may do what a handler may not.
class SignalThread {
 public:
  // end: called there, once one of them has come, and ends the process. handled_too: also where it came to the handler
  // of catch_interrupts(), as threads that were there before do not block the signals.
  SignalThread(bool handled_too, std::function<void()> end);
  ~SignalThread();
  SignalThread(const SignalThread&) = delete;
  SignalThread& operator=(const SignalThread&) = delete;

 private:
  sigset_t before_;  // the signals that were blocked
  std::jthread waiting_;
};

// While it lives, SIGINT and SIGTERM end the process at once, with exit code 130. It is for work that takes long and
// leaves nothing to keep, such as loading a scene. clean_up: called before, on another thread; message: said on stderr,
// if it is not empty.
class EndOnInterrupt {
 public:
  EndOnInterrupt(std::function<void()> clean_up, std::string message);

 private:
  SignalThread thread_;
};

// While it lives, SIGINT and SIGTERM end the process at once, with exit code 130, and leave nothing of what is being
// written to `output` (PendingFile and PendingFolder) behind, nor the folders above it that are not there yet. It is
// for commands whose work has no places to stop at.
class RemoveOnInterrupt {
 public:
  explicit RemoveOnInterrupt(const std::filesystem::path& output);

 private:
  SignalThread thread_;
};

}  // namespace wavetracer
