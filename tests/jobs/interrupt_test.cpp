// What an interrupt says of files, in a process of its own: before and after they have got their final names.
#include "jobs/interrupt.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <iostream>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "temporary_folder.hpp"

using namespace wavetracer;
namespace fs = std::filesystem;

namespace {

// What a process says that writes to `output` and is told to end before or after it has given the file its name.
std::string interrupted_words(const fs::path& output, bool named, const fs::path& messages) {
  std::cout.flush();  // or both processes write what waits there
  const pid_t process = fork();
  if (process == 0) {
    const int file = open(messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(file, STDERR_FILENO);
    const RemoveOnInterrupt guard(output);
    PendingFile pending(output, {});
    if (named) pending.commit();
    kill(getpid(), SIGTERM);
    while (true) pause();
  }
  int status = 0;
  REQUIRE(waitpid(process, &status, 0) == process);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
  return read_file(messages);
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
