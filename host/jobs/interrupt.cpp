// The signal handler sets a flag and says so by write(), which a handler may call; nothing else.
// SA_RESETHAND restores the default action, so that a second signal ends the process.
// EndOnInterrupt and RemoveOnInterrupt wait for signals on a thread of their own, which may remove folders as a handler
// may not.
#include "jobs/interrupt.hpp"
#include <unistd.h>
#include <csignal>
#include <iostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include "base/output_place.hpp"
#include "base/pending_hold.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

volatile std::sig_atomic_t raised = 0;

sigset_t ending_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

// The path and the folders above it, the innermost first, as far as they are not there.
std::vector<fs::path> missing(fs::path path) {
  std::vector<fs::path> out;
  std::error_code ignored;
  for (; !path.empty() && path.has_relative_path() && !fs::exists(path, ignored); path = path.parent_path())
    out.push_back(path);
  return out;
}

// Calls end() when one of the signals has come, here or, where `elsewhere` is true, to a handler; else returns when it
// is asked to stop.
template <class End>
void wait_for_signal(const std::stop_token& stop, bool elsewhere, const End& end) {
  const sigset_t set = ending_signals();
  const timespec tenth{0, 100'000'000};
  while (!stop.stop_requested())
    if ((elsewhere && interrupted()) || sigtimedwait(&set, nullptr, &tenth) >= 0) end();
}

[[noreturn]] void end_interrupted(const std::string& message) {
  if (!message.empty()) std::cerr << "wavetracer: " << message << std::endl;
  _exit(static_cast<int>(ExitCode::interrupted));
}

// named_before: final_names() before anything was written.
[[noreturn]] void remove_and_end(const fs::path& temporary, const std::vector<fs::path>& folders,
                                 uint64_t named_before) {
  const auto hold = hold_pending();  // to the end of the process
  std::error_code ignored;
  fs::remove_all(temporary, ignored);
  const bool nothing = final_names() == named_before;
  if (nothing)
    for (const fs::path& folder : folders) fs::remove(folder, ignored);  // those that are empty
  end_interrupted(std::string("interrupted; ") + (nothing ? "nothing was written" : "what was written is complete"));
}

}  // namespace

void catch_interrupts(bool acknowledge) {
  struct sigaction action = {};
  if (acknowledge)
    action.sa_handler = [](int) {
      raised = 1;
      constexpr std::string_view text = "\ninterrupted: stopping after the step in progress; once more ends at once\n";
      if (write(STDERR_FILENO, text.data(), text.size()) < 0) return;  // nobody is there to read it
    };
  else
    action.sa_handler = [](int) { raised = 1; };
  action.sa_flags = SA_RESTART | SA_RESETHAND;  // a write to a file goes on
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

EndOnInterrupt::EndOnInterrupt(std::function<void()> clean_up, std::string message) {
  const sigset_t set = ending_signals();
  pthread_sigmask(SIG_BLOCK, &set, &before_);
  waiting_ = std::jthread([clean_up = std::move(clean_up), message = std::move(message)](const std::stop_token& stop) {
    wait_for_signal(stop, true, [&] {  // threads of drivers that were there before do not block the signals
      clean_up();
      end_interrupted(message);
    });
  });
}

EndOnInterrupt::~EndOnInterrupt() {
  waiting_.request_stop();
  waiting_.join();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

RemoveOnInterrupt::RemoveOnInterrupt(const fs::path& output) {
  const fs::path temporary = temporary_beside(behind_links(output.has_filename() ? output : output.parent_path()));
  const sigset_t set = ending_signals();
  pthread_sigmask(SIG_BLOCK, &set, &before_);
  // Counted here and not by the thread, which may start after the output has got its name.
  waiting_ =
      std::jthread([temporary, folders = missing(output), named = final_names().load()](const std::stop_token& stop) {
        wait_for_signal(stop, false, [&] { remove_and_end(temporary, folders, named); });
      });
}

RemoveOnInterrupt::~RemoveOnInterrupt() {
  waiting_.request_stop();
  waiting_.join();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

bool interrupted() { return raised != 0; }

}  // namespace wavetracer
