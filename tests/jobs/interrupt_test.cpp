// SPDX-License-Identifier: Apache-2.0
// Checks the messages of an interrupt about files, in a separate process: before and after they have got their final
// names.
#include "jobs/interrupt.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <iostream>
#include <thread>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "temporary_folder.hpp"

using namespace wavetracer;
namespace fs = std::filesystem;

namespace {

// Returns what a process that does this, and waits to be ended, prints on stderr.
std::string last_words(const std::function<void()>& begin_and_wait, const fs::path& messages) {
  std::cout.flush();  // otherwise both processes would write the buffered text
  const pid_t process = fork();
  if (process == 0) {
    const int file = open(messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(file, STDERR_FILENO);
    begin_and_wait();
  }
  int status = 0;
  REQUIRE(waitpid(process, &status, 0) == process);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
  return read_file(messages);
}

[[noreturn]] void wait_for_the_end() {
  while (true) pause();
}

// Does the same for one that writes to `output` and is told to end before or after it has given the file its name.
std::string interrupted_words(const fs::path& output, bool named, const fs::path& messages) {
  return last_words(
      [&] {
        const RemoveOnInterrupt guard(output);
        PendingFile pending(output, {});
        if (named) pending.commit();
        kill(getpid(), SIGTERM);
        wait_for_the_end();
      },
      messages);
}

}  // namespace

TEST_CASE("an interrupt says that nothing was written only where this is so") {
  const test::TemporaryFolder folder;
  const fs::path output = folder.path() / "run.npz", messages = folder.path() / "messages";
  CHECK(interrupted_words(output, false, messages) == "wavetracer: interrupted; nothing was written\n");
  CHECK_FALSE(fs::exists(output));
  CHECK(interrupted_words(output, true, messages) == "wavetracer: interrupted; what was written is complete\n");
  CHECK(fs::exists(output));
}

TEST_CASE("a signal that any thread handles is seen by the thread that waits for it") {
  const test::TemporaryFolder folder;
  const std::string words = last_words(
      [] {
        catch_interrupts(false);
        std::thread other(wait_for_the_end);
        const EndOnInterrupt guard([] {}, "ended");
        pthread_kill(other.native_handle(), SIGTERM);
        wait_for_the_end();
      },
      folder.path() / "messages");
  CHECK(words == "wavetracer: ended\n");  // and the thread sanitizer reports nothing
}
