// SPDX-License-Identifier: Apache-2.0
// A forked copy of this process that tries many inputs, for targets that call a library which damaged files can crash.
// It tells whether a fault was in that library, and which inputs reach code that none has reached before.
#pragma once
#include <execinfo.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include "fuzz/children.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::fuzz {

// Returns the counters of coverage of this program; none if it is no fuzzer.
std::span<uint8_t> counters();
// Copies the counters to `last`, and adds the kinds of their values to `seen`. Returns whether a counter has a value
// whose highest bit it never had. Both have the size of the counters.
bool note_coverage(uint8_t* last, uint8_t* seen);

// A try ends with an answer; with one that leaves things behind, so that the process must not go on; with an exception
// that is no Error; with a fault or too much time in the library, or elsewhere.
enum class End : uint8_t { answer, remains, exception, library, elsewhere };

// The code of a shared library.
class LibraryCode {
 public:
  // inside: an address in it, or null for a library that is never called.
  explicit LibraryCode(const void* inside) : inside_(reinterpret_cast<uintptr_t>(inside)) {
    if (inside && !dl_iterate_phdr(find, this)) std::abort();
    void* first[1];
    backtrace(first, 1);  // loads what it needs, which a signal handler must not do
  }
  // Tells whether this thread is in a call of the library. It may be called by a signal handler.
  bool is_called() const {
    std::array<void*, 200> frames;
    const int count = backtrace(frames.data(), static_cast<int>(frames.size()));
    return std::any_of(frames.begin(), frames.begin() + count, [this](const void* frame) {
      const auto at = reinterpret_cast<uintptr_t>(frame);
      return at >= begin_ && at < end_;
    });
  }

 private:
  static int find(dl_phdr_info* object, size_t, void* self) {
    auto& code = *static_cast<LibraryCode*>(self);
    for (int i = 0; i < object->dlpi_phnum; ++i) {
      const auto& part = object->dlpi_phdr[i];
      code.begin_ = object->dlpi_addr + part.p_vaddr;
      code.end_ = code.begin_ + part.p_memsz;
      if (part.p_type == PT_LOAD && code.inside_ >= code.begin_ && code.inside_ < code.end_) return 1;
    }
    return 0;
  }
  uintptr_t inside_, begin_ = 0, end_ = 0;
};

class Worker {
 public:
  static constexpr size_t most_inputs = 200;
  // Tries one input in the forked process. Returns false if that process must not try another.
  using Try = std::function<bool(std::string_view input)>;

  // library: an address in the code of the library that may crash, or null.
  Worker(const void* library, Try one) : library_(library), try_(std::move(one)) {
    const size_t bytes = sizeof(Shared) + 2 * counters().size();
    void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) std::abort();
    shared_ = static_cast<Shared*>(memory);
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // Tries inputs one after the other in a new process, up to the first that does not end with an answer. Returns how
  // the last one ended. The coverage of the last one becomes that of this process.
  End run(std::span<const std::string> inputs) {
    shared_->tried = 0;
    shared_->end = End::elsewhere;  // for the case that the process is gone before it can tell
    const pid_t process = fork();
    if (process < 0) std::abort();
    if (process == 0) serve(inputs);
    while (waitpid(process, nullptr, 0) < 0 && errno == EINTR) {
    }
    std::copy_n(last(), counters().size(), counters().begin());
    return shared_->end;
  }
  End run(const std::string& input) { return run({&input, 1}); }
  // Returns the number of inputs that the last process has tried.
  size_t tried() const { return shared_->tried; }
  // Tells whether this input of the last process reached something new.
  bool is_new(size_t input) const { return shared_->is_new[input]; }

 private:
  struct Shared {
    size_t tried = 0;
    End end = End::answer;
    std::array<bool, most_inputs> is_new{};
  };

  // For each counter: its value after the last input, and the kinds of values that it had so far.
  uint8_t* last() const { return reinterpret_cast<uint8_t*>(shared_ + 1); }
  uint8_t* seen() const { return last() + counters().size(); }

  [[noreturn]] void serve(std::span<const std::string> inputs) {
    current() = this;
    catch_faults();
    limit_memory();
    End end = End::answer;
    for (size_t i = 0; i < inputs.size() && end == End::answer; ++i) {
      limit_time();
      shared_->tried = i + 1;
      std::ranges::fill(counters(), uint8_t{0});
      end = try_one(inputs[i]);
      shared_->is_new[i] = note_coverage(last(), seen());
    }
    shared_->end = end;
    _exit(0);
  }

  End try_one(std::string_view input) const {
    try {
      return try_(input) ? End::answer : End::remains;
    } catch (const Error&) {
      return End::answer;
    } catch (const std::exception&) {
      return End::exception;
    }
  }

  static Worker*& current() {
    static Worker* worker = nullptr;
    return worker;
  }
  static void note_fault() {
    if (const Worker* const worker = current())
      worker->shared_->end = worker->library_.is_called() ? End::library : End::elsewhere;
  }
  static void end_by(int) {
    note_fault();
    _exit(1);
  }
  static void catch_faults() {
    static std::array<char, 1 << 18> stack;  // a fault may be the end of the normal stack
    const stack_t other{stack.data(), 0, stack.size()};
    sigaltstack(&other, nullptr);
    struct sigaction action {};
    action.sa_handler = end_by;
    action.sa_flags = SA_ONSTACK;
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGVTALRM}) sigaction(signal, &action, nullptr);
    if (__sanitizer_set_death_callback) __sanitizer_set_death_callback(note_fault);
  }
  static void limit_time() {
    const itimerval limit{{0, 0}, {0, 500000}};  // processor time of all threads
    setitimer(ITIMER_VIRTUAL, &limit, nullptr);
  }
  // libFuzzer takes an allocation of 1 GiB for a finding, so such a one must fail.
  static void limit_memory() {
    uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t bytes = pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE)) + (uint64_t{1} << 30);
    const rlimit limit{bytes, bytes}, none{0, 0};
    setrlimit(RLIMIT_AS, &limit);
    setrlimit(RLIMIT_CORE, &none);
  }

  LibraryCode library_;
  Try try_;
  Shared* shared_ = nullptr;
};

}  // namespace wavetracer::fuzz
