// In place of hdf5::rehearse(), whose process for each file would take most of the time: one process that reads file
// after file, and a new one where the HDF5 library faults in it or takes more than a second.
#pragma once
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <utility>

// Of the sanitizers, where they are: else each fault would count as a finding.
extern "C" __attribute__((weak)) void __sanitizer_set_death_callback(void (*callback)());

namespace wavetracer::fuzz {

class Rehearsal {
 public:
  // reading: of the input in its file, again and again; its exceptions do not matter.
  explicit Rehearsal(std::function<void()> reading) : reading_(std::move(reading)) {}
  ~Rehearsal() { end(); }
  Rehearsal(const Rehearsal&) = delete;
  Rehearsal& operator=(const Rehearsal&) = delete;

  // True in the process that reads.
  static bool here() { return here_; }

  bool survived() {
    if (child_ < 0 || rehearsals_ == most_rehearsals) start();
    ++rehearsals_;
    char word = 0;
    if (write(socket_, &word, 1) == 1 && read(socket_, &word, 1) == 1) return true;
    end();
    return false;
  }

 private:
  static constexpr int most_rehearsals = 5000;  // so that what the library leaks goes
  static inline bool here_ = false;
  std::function<void()> reading_;
  pid_t child_ = -1;
  int socket_ = -1, rehearsals_ = 0;

  void start() {
    end();
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) std::abort();
    child_ = fork();
    if (child_ < 0) std::abort();
    if (child_ == 0) {
      close(ends[1]);
      run(ends[0]);
    }
    close(ends[0]);
    socket_ = ends[1];
    rehearsals_ = 0;
  }

  void end() {
    if (child_ < 0) return;
    close(socket_);
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
    child_ = -1;
  }

  [[noreturn]] void run(int socket) {
    here_ = true;
    if (__sanitizer_set_death_callback) __sanitizer_set_death_callback(nullptr);
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGPROF}) std::signal(signal, SIG_DFL);
    std::signal(SIGPIPE, SIG_IGN);
    for (char word; read(socket, &word, 1) == 1;) {
      limit_time(1);
      try {
        reading_();
      } catch (...) {
      }
      limit_time(0);
      if (write(socket, &word, 1) != 1) break;
    }
    _exit(0);
  }

  static void limit_time(long seconds) {
    const itimerval time{{0, 0}, {seconds, 0}};
    setitimer(ITIMER_PROF, &time, nullptr);
  }
};

}  // namespace wavetracer::fuzz
