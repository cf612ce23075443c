// SPDX-License-Identifier: Apache-2.0
// The signal handler sets a flag and reports it by write(), which a handler may call, and does nothing else.
// SA_RESETHAND restores the default action, so that a second signal ends the process.
#include "jobs/interrupt.hpp"
#include <unistd.h>
#include <atomic>
#include <csignal>
#include <iostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include "base/output_place.hpp"
#include "base/pending_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

// Set by the thread that handles the signal, and read by others.
std::atomic<bool> raised{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // otherwise a handler must not use it

sigset_t ending_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

// Returns the path and the folders above it that do not exist, the innermost first.
std::vector<fs::path> missing(fs::path path) {
  std::vector<fs::path> out;
  std::error_code ignored;
  for (; !path.empty() && path.has_relative_path() && !fs::exists(path, ignored); path = path.parent_path())
    out.push_back(path);
  return out;
}

[[noreturn]] void end_interrupted(const std::string& message) {
  if (!message.empty()) std::cerr << "wavetracer: " << message << std::endl;
  _exit(static_cast<int>(ExitCode::interrupted));
}

// named_before: final_names() before anything was written.
[[noreturn]] void remove_and_end(const fs::path& temporary, const std::vector<fs::path>& folders,
                                 uint64_t named_before) {
  const auto hold = hold_pending();  // held until the process ends
  std::error_code ignored;
  fs::remove_all(temporary, ignored);
  const bool nothing = final_names() == named_before;
  if (nothing)
    for (const fs::path& folder : folders) fs::remove(folder, ignored);  // only empty ones are removed
  end_interrupted(std::string("interrupted; ") + (nothing ? "nothing was written" : "what was written is complete"));
}

}  // namespace

void catch_interrupts(bool acknowledge) {
  struct sigaction action = {};
  if (acknowledge)
    action.sa_handler = [](int) {
      raised = true;
      constexpr std::string_view text =
          "\ninterrupted: stopping after the step in progress; a second signal ends at once\n";
      if (write(STDERR_FILENO, text.data(), text.size()) < 0) return;  // if nobody reads it, that does not matter
    };
  else
    action.sa_handler = [](int) { raised = true; };
  action.sa_flags = SA_RESTART | SA_RESETHAND;  // an interrupted write to a file continues
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

SignalThread::SignalThread(bool handled_too, std::function<void()> end) {
  const sigset_t set = ending_signals();
  pthread_sigmask(SIG_BLOCK, &set, &before_);
  waiting_ = std::jthread([handled_too, end = std::move(end)](const std::stop_token& stop) {
    const sigset_t awaited = ending_signals();
    const timespec tenth{0, 100'000'000};
    while (!stop.stop_requested())
      if ((handled_too && interrupted()) || sigtimedwait(&awaited, nullptr, &tenth) >= 0) end();
  });
}

SignalThread::~SignalThread() {
  waiting_.request_stop();
  waiting_.join();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

EndOnInterrupt::EndOnInterrupt(std::function<void()> clean_up, std::string message)
    : thread_(true, [clean_up = std::move(clean_up), message = std::move(message)] {
        clean_up();
        end_interrupted(message);
      }) {}

// Names are counted here and not by the thread, which may start after the output has got its name.
RemoveOnInterrupt::RemoveOnInterrupt(const fs::path& output)
    : thread_(false, [temporary = temporary_beside(behind_links(output.has_filename() ? output : output.parent_path())),
                      folders = missing(output),
                      named = final_names().load()] { remove_and_end(temporary, folders, named); }) {}

bool interrupted() { return raised; }

}  // namespace wavetracer
