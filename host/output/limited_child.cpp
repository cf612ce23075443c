// SPDX-License-Identifier: Apache-2.0
// Uses a pair of sockets. A request is its length and its bytes; an answer is a series of messages: data, names of
// files, and at its end "done" or an error. The limits are the address space, which bounds the library's allocations,
// and a timer of processor time.
#include "output/limited_child.hpp"
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <new>
#include <utility>
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

enum class Kind : uint32_t { data, file, done, error };

struct Head {
  Kind kind = Kind::done;
  ExitCode code = ExitCode::ok;  // exit code of an error
  uint64_t bytes = 0;            // number of bytes that follow
};

constexpr uint64_t longest_text = uint64_t{1} << 20, longest_data = uint64_t{1} << 30;  // limits of one message

// Returns false if the other end is gone.
bool send_all(int socket, const void* data, size_t bytes) {
  for (auto* p = static_cast<const char*>(data); bytes > 0;) {
    const ssize_t sent = ::send(socket, p, bytes, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    p += sent;
    bytes -= static_cast<size_t>(sent);
  }
  return true;
}

bool receive_all(int socket, void* data, size_t bytes) {
  for (auto* p = static_cast<char*>(data); bytes > 0;) {
    const ssize_t received = ::recv(socket, p, bytes, 0);
    if (received < 0 && errno == EINTR) continue;
    if (received <= 0) return false;
    p += received;
    bytes -= static_cast<size_t>(received);
  }
  return true;
}

// If the parent is gone, the child ends: nobody is left to answer.
void send_or_end(int socket, const Head& head, const void* data) {
  if (!send_all(socket, &head, sizeof head) || !send_all(socket, data, head.bytes)) _exit(0);
}

void send_error(int socket, ExitCode code, std::string_view text) {
  text = text.substr(0, longest_text);
  send_or_end(socket, {Kind::error, code, text.size()}, text.data());
}

void lower_limit(int resource, rlim_t limit) {
  rlimit old{};
  getrlimit(static_cast<__rlimit_resource>(resource), &old);
  const rlimit lower{std::min(limit, old.rlim_max), old.rlim_max};
  setrlimit(static_cast<__rlimit_resource>(resource), &lower);
}

void set_limits(const ChildLimits& limits) {
  uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  if (pages > 0) lower_limit(RLIMIT_AS, pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE)) + limits.bytes);
  lower_limit(RLIMIT_CORE, 0);
  // The parent's signal handlers must not run in the child.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGPROF}) std::signal(signal, SIG_DFL);
}

void start_timer(int seconds) {
  const itimerval timer{{0, 0}, {seconds, 0}};
  setitimer(ITIMER_PROF, &timer, nullptr);  // sends SIGPROF
}

[[noreturn]] void serve(int socket, const LimitedChild::Answer& answer, const ChildLimits& limits) {
  set_limits(limits);
  LimitedChild::Reply reply(socket, limits.seconds);
  std::string request;
  for (uint64_t bytes = 0; receive_all(socket, &bytes, sizeof bytes);) {
    request.resize(bytes);
    if (!receive_all(socket, request.data(), bytes)) break;
    start_timer(limits.seconds);
    try {
      answer(request, reply);
      send_or_end(socket, {}, nullptr);
    } catch (const Error& error) {
      send_error(socket, error.code(), error.what());
    } catch (const std::bad_alloc&) {
      send_error(socket, ExitCode::runtime,
                 fmt::format("reading it takes more than {} MiB of memory", limits.bytes >> 20));
    } catch (const std::exception& error) {
      send_error(socket, ExitCode::runtime, error.what());
    }
  }
  _exit(0);  // _exit(): no buffer of the parent is flushed, no file of it removed
}

std::string end_words(int status, int seconds) {
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGPROF) return fmt::format("reading it takes more than {} s; it may be damaged", seconds);
  if (signal == SIGKILL) return "the process that reads it was killed, perhaps because it ran out of memory";
  return "the file is damaged: the HDF5 library fails on it; copy it again, or compute it again";
}

void wait_for(pid_t process, int* status) {
  while (waitpid(process, status, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace

void LimitedChild::Reply::send(const void* data, size_t bytes) {
  for (auto* p = static_cast<const char*>(data); bytes > 0;) {
    const size_t some = std::min(bytes, size_t{longest_data});
    send_or_end(socket_, {Kind::data, ExitCode::ok, some}, p);
    p += some;
    bytes -= some;
  }
}

void LimitedChild::Reply::at_file(const std::string& file) {
  start_timer(seconds_);
  send_or_end(socket_, {Kind::file, ExitCode::ok, std::min(file.size(), size_t{longest_text})}, file.data());
}

LimitedChild::LimitedChild(std::string file, Answer answer, ChildLimits limits)
    : file_(std::move(file)), limits_(limits) {
  const auto failed = [] { throw RuntimeError(std::string("cannot start a process: ") + std::strerror(errno)); };
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) failed();
  process_ = fork();
  if (process_ == 0) {
    close(ends[0]);
    serve(ends[1], answer, limits);
  }
  close(ends[1]);
  socket_ = ends[0];
  if (process_ < 0) {
    close(socket_);
    failed();
  }
}

LimitedChild::~LimitedChild() {
  close(socket_);
  if (process_ <= 0) return;
  kill(process_, SIGKILL);  // it has nothing to finish, and other children may keep its socket open
  wait_for(process_, nullptr);
}

void LimitedChild::fail() {
  if (process_ > 0) {
    int status = 0;
    kill(process_, SIGKILL);  // in case it has not ended, but its answers are invalid or too large
    wait_for(process_, &status);
    process_ = -1;
    end_ = end_words(status, limits_.seconds);
  }
  throw InputError(fmt::format("{}: {}", file_, end_));
}

void LimitedChild::receive_data(uint64_t bytes, const Room& room) {
  if (bytes > longest_data) fail();
  void* to = nullptr;
  try {
    to = room(bytes);
  } catch (const std::exception&) {
    fail();
  }
  if (!receive_all(socket_, to, bytes)) fail();
}

void LimitedChild::request(std::string_view request, const Room& room) {
  const uint64_t bytes = request.size();
  if (process_ < 0 || !send_all(socket_, &bytes, sizeof bytes) || !send_all(socket_, request.data(), bytes)) fail();
  for (;;) {
    Head head;
    if (!receive_all(socket_, &head, sizeof head)) fail();
    if (head.kind == Kind::done) return;
    if (head.kind == Kind::data) {
      receive_data(head.bytes, room);
      continue;
    }
    if (head.bytes > longest_text) fail();
    std::string text(head.bytes, '\0');
    if (!receive_all(socket_, text.data(), text.size())) fail();
    if (head.kind == Kind::file) {
      file_ = text;
    } else if (head.code == ExitCode::input) {
      throw InputError(text);
    } else {
      throw RuntimeError(text);
    }
  }
}

std::string LimitedChild::request(std::string_view request) {
  std::string answer;
  this->request(request, [&answer](size_t bytes) {
    answer.resize(answer.size() + bytes);
    return answer.data() + answer.size() - bytes;
  });
  return answer;
}

}  // namespace wavetracer
