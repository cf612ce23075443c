// SPDX-License-Identifier: Apache-2.0
// Ctrl-C: the first one asks the run to stop after its current step, the second one ends it at once.
// A process has one such request, which is never withdrawn.
#pragma once
#include <signal.h>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

namespace wavetracer {

// From now on SIGINT and SIGTERM only set the request. acknowledge: also print a line on stderr at once.
void catch_interrupts(bool acknowledge = true);
bool interrupted();

// While it exists, SIGINT and SIGTERM go to a thread, which may do what a handler may not.
class SignalThread {
 public:
  // end: called on that thread once a signal has come; it ends the process. handled_too: also if the handler of
  // catch_interrupts() got the signal, since threads that existed before do not block the signals.
  SignalThread(bool handled_too, std::function<void()> end);
  ~SignalThread();
  SignalThread(const SignalThread&) = delete;
  SignalThread& operator=(const SignalThread&) = delete;

 private:
  sigset_t before_;  // the signals that were blocked before
  std::jthread waiting_;
};

// While it exists, SIGINT and SIGTERM end the process at once, with exit code 130. It is for work that takes long and
// leaves nothing to keep, such as loading a scene. clean_up: called before, on another thread; message: printed on
// stderr if it is not empty.
class EndOnInterrupt {
 public:
  EndOnInterrupt(std::function<void()> clean_up, std::string message);

 private:
  SignalThread thread_;
};

// While it exists, SIGINT and SIGTERM end the process at once, with exit code 130, and remove everything that is being
// written to `output` (PendingFile and PendingFolder), and the folders above it that did not exist. It is for commands
// whose work cannot stop midway.
class RemoveOnInterrupt {
 public:
  explicit RemoveOnInterrupt(const std::filesystem::path& output);

 private:
  SignalThread thread_;
};

}  // namespace wavetracer
