// SPDX-License-Identifier: Apache-2.0
// Starts a child process in the folder of the script; gnuplot's messages go to standard error.
// It needs POSIX with posix_spawn_file_actions_addchdir_np.
#include "plots/gnuplot.hpp"
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <array>
#include <cerrno>
#include <cstring>

extern char** environ;

namespace wavetracer::plots {

std::string quoted(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'')
      out += "''";
    else
      out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out;
}

std::string run_gnuplot(const std::filesystem::path& folder, const std::string& script) {
  std::string program = "gnuplot", file = script;
  std::array<char*, 3> arguments = {program.data(), file.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t process = 0;
  const int problem = posix_spawnp(&process, "gnuplot", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  const std::string again = fmt::format("; then run `gnuplot {}` in {}", script, folder.string());
  if (problem == ENOENT)
    return "gnuplot is not installed, so the plot is not drawn: install it (Debian: apt-get install gnuplot-nox)" +
           again;
  if (problem != 0) return fmt::format("gnuplot cannot be started, {}{}", std::strerror(problem), again);
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
  return "gnuplot failed, so the plot is not drawn: see what it says above" + again;
}

}  // namespace wavetracer::plots
