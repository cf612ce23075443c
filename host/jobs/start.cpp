// SPDX-License-Identifier: Apache-2.0
// Uses posix_spawn, and one pipe per child for its messages.
// Children are in process groups of their own, so that Ctrl-C on the terminal reaches them once, through the parent.
#include "jobs/start.hpp"
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <random>
#include <set>
#include "jobs/interrupt.hpp"

extern char** environ;

namespace wavetracer {
namespace {

struct Child {
  pid_t process = -1;
  int messages = -1;  // end of a pipe
  std::string half_line;
  int status = 0;
};

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> out;
  for (std::string& word : words) out.push_back(word.data());
  out.push_back(nullptr);
  return out;
}

// Returns this process's variables and those that tell a child its rank.
std::vector<std::string> environment_of(uint32_t rank, const ProcessPlan& plan, const std::string& job) {
  std::vector<std::string> out;
  for (char** entry = environ; *entry; ++entry)
    if (const std::string variable = *entry; !variable.starts_with("WAVETRACER_RANK") &&
                                             !variable.starts_with("WAVETRACER_JOB=") &&
                                             !variable.starts_with("WAVETRACER_COMMAND="))
      out.push_back(variable);
  out.push_back(fmt::format("WAVETRACER_RANK={}", rank));
  out.push_back(fmt::format("WAVETRACER_RANKS={}", plan.processes));
  out.push_back("WAVETRACER_JOB=" + job);
  out.push_back("WAVETRACER_COMMAND=" + plan.command_line);
  return out;
}

Child start_child(uint32_t rank, const ProcessPlan& plan, const std::string& job) {
  std::vector<std::string> words{"wavetracer"}, variables = environment_of(rank, plan, job);
  words.insert(words.end(), plan.arguments.begin(), plan.arguments.end());
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw RuntimeError(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  Child child;
  child.messages = ends[0];
  const int failed = posix_spawn(&child.process, "/proc/self/exe", &actions, &attributes, pointers(words).data(),
                                 pointers(variables).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (failed != 0) throw RuntimeError(fmt::format("cannot start a process: {}", std::strerror(failed)));
  return child;
}

// Messages of children; each is printed once, unless it begins with the name of the child.
class Messages {
 public:
  explicit Messages(Progress& progress) : progress_(progress) {}

  void take(Child& child, const char* text, size_t bytes) {
    child.half_line.append(text, bytes);
    for (size_t end; (end = child.half_line.find('\n')) != std::string::npos;) {
      say(child.half_line.substr(0, end));
      child.half_line.erase(0, end + 1);
    }
  }
  void end(Child& child) {
    if (!child.half_line.empty()) say(child.half_line);
    close(child.messages);
    child.messages = -1;
  }

 private:
  Progress& progress_;
  std::set<std::string> said_;

  void say(const std::string& line) {
    if (line.starts_with("rank ") || said_.insert(line).second) progress_.line(line);
  }
};

// Runs until all children have closed their pipes.
void listen(std::vector<Child>& children, Progress& progress) {
  Messages messages(progress);
  bool told = false;
  for (;;) {
    if (interrupted() && !told) {
      for (const Child& child : children)
        if (child.messages >= 0) kill(child.process, SIGINT);
      told = true;
    }
    std::vector<pollfd> waiting;
    for (const Child& child : children)
      if (child.messages >= 0) waiting.push_back({child.messages, POLLIN, 0});
    if (waiting.empty()) return;
    // An interrupt may come just before poll(), which would then not return because of it.
    if (poll(waiting.data(), waiting.size(), 200) <= 0) continue;
    for (const pollfd& ready : waiting) {
      if (ready.revents == 0) continue;
      Child& child = *std::ranges::find(children, ready.fd, &Child::messages);
      char text[4096];
      const ssize_t bytes = read(ready.fd, text, sizeof text);
      if (bytes < 0 && errno == EINTR) continue;
      if (bytes > 0) {
        messages.take(child, text, static_cast<size_t>(bytes));
      } else {
        messages.end(child);
      }
    }
  }
}

int code_of(const Child& child) { return WIFEXITED(child.status) ? WEXITSTATUS(child.status) : -1; }

}  // namespace

ExitCode start_processes(const ProcessPlan& plan, Progress& progress) {
  const std::string job = fmt::format("{} {:08x}{:08x}", getpid(), std::random_device{}(), std::random_device{}());
  std::vector<Child> children;
  for (uint32_t rank = 0; rank < plan.processes; ++rank) children.push_back(start_child(rank, plan, job));
  listen(children, progress);
  for (Child& child : children)
    while (waitpid(child.process, &child.status, 0) < 0 && errno == EINTR) {
    }
  for (uint32_t rank = 0; rank < children.size(); ++rank)
    if (WIFSIGNALED(children[rank].status))
      progress.line(fmt::format("rank {} was ended by signal {} ({})", rank, WTERMSIG(children[rank].status),
                                strsignal(WTERMSIG(children[rank].status))));
  const auto any = [&](ExitCode code) {
    return std::ranges::any_of(children, [code](const Child& c) { return code_of(c) == static_cast<int>(code); });
  };
  if (any(ExitCode::interrupted)) return ExitCode::interrupted;
  if (any(ExitCode::partial)) return ExitCode::partial;
  if (any(ExitCode::ok)) return ExitCode::ok;  // a child that ends well has seen all parts finished
  for (const Child& child : children)
    if (code_of(child) > 0) return static_cast<ExitCode>(code_of(child));
  return ExitCode::runtime;
}

}  // namespace wavetracer
