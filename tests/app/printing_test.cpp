// SPDX-License-Identifier: Apache-2.0
// Output of the program arrives, or the exit code says that it did not; an output with the name of a pipe or a device
// is written there. The shell connects standard output to /dev/full, where every write fails.
#include <doctest/doctest.h>
#include <sys/stat.h>
#include <cstdlib>
#include <filesystem>
#include <future>
#include "folders.hpp"
#include "program.hpp"

namespace {

namespace fs = std::filesystem;

struct Printed {
  int code;
  std::string err;
};

// redirection: of the shell, such as ">/dev/full".
Printed with_output(const std::string& words, const std::string& redirection) {
  const Folder folder;
  const std::string command = std::string("'") + wavetracer::test::program() + "' " + words + " " + redirection +
                              " 2>'" + folder.path("err") + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder.path("err"))};
}

const std::string two_ends =
    "scene.generate = \"--blocks 2\"\n[[transmitter]]\nname = \"t\"\nposition_m = [0, 0, 6]\n"
    "[[receiver]]\nname = \"r\"\nposition_m = [50, 0, 2]\n";

}  // namespace

TEST_CASE("every command that prints fails where standard output is full or closed") {
  const Folder folder;
  const std::string config = "'" + folder.file("a.toml", two_ends) + "'";
  const std::string room = "'" + wavetracer::test::source_folder() + "/configs/scenes/room/room.xml'";
  for (const std::string& words : {std::string("--version"),
                                   std::string("--help"),
                                   std::string("help"),
                                   std::string("help config"),
                                   std::string("help trace.rays"),
                                   std::string("help run"),
                                   std::string("run --help"),
                                   std::string("init"),
                                   std::string("init --minimal"),
                                   std::string("init --sumo"),
                                   std::string("init --coverage"),
                                   std::string("documentation --reference"),
                                   std::string("documentation --materials"),
                                   std::string("documentation --man program"),
                                   std::string("documentation --man config"),
                                   std::string("documentation --completion bash"),
                                   std::string("thesis"),
                                   std::string("convert --list"),
                                   "scene info " + room,
                                   "scene info --edges " + room,
                                   std::string("scene materials"),
                                   "validate -c " + config,
                                   "scene city -o '" + folder.path("city") + "'"}) {
    CAPTURE(words);
    for (const char* redirection : {">/dev/full", ">&-"}) {
      CAPTURE(redirection);
      const Printed printed = with_output(words, redirection);
      CHECK(printed.code == 1);
      CHECK(contains(printed.err, "standard output cannot be written"));
    }
    CHECK(with_output(words, ">/dev/null").code == 0);
  }
  CHECK(contains(with_output("init", ">/dev/full").err, "No space left on device"));
}

TEST_CASE("the list of devices that nobody got is an error") {
  if (!device_present()) return;
  CHECK(with_output("devices", ">/dev/full").code == 1);
}

TEST_CASE("a message for a closed standard error goes nowhere, least of all into a file that is written") {
  const Folder folder;
  const std::string page = folder.path("page.md");
  CHECK(std::system((std::string("'") + wavetracer::test::program() + "' documentation --reference -o '" + page +
                     "' <&- >&- 2>&-")
                        .c_str()) == 0);
  CHECK(contents(page) == run_program({"documentation", "--reference"}).out);
}

TEST_CASE("-o with a pipe, or a link, writes there; standard output by its name is no file to replace") {
  const Folder folder;
  const std::string text = run_program({"documentation", "--reference"}).out, pipe = folder.path("pipe");
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  auto reading = std::async(std::launch::async, [&] { return contents(pipe); });
  CHECK(run_program({"documentation", "--reference", "-o", pipe}).code == 0);
  CHECK(reading.get() == text);
  CHECK(fs::is_fifo(pipe));
  fs::create_symlink("page.md", folder.path("link"));
  CHECK(run_program({"documentation", "--reference", "-o", folder.path("link")}).code == 0);
  CHECK(fs::is_symlink(folder.path("link")));
  CHECK(contents(folder.path("page.md")) == text);
  const std::string through = folder.path("through");
  CHECK(std::system((std::string("'") + wavetracer::test::program() +
                     "' documentation --reference -o /dev/stdout | cat > '" + through + "'")
                        .c_str()) == 0);
  CHECK(contents(through) == text);
}

TEST_CASE("a run refuses a device or a pipe in the place of a result before it begins") {
  const Folder folder;
  const std::string config = folder.file("a.toml", two_ends);
  for (const char* name : {"paths.h5", "links.csv", "summary.json"}) {
    const std::string out = folder.path(std::string("out_") + name);
    fs::create_directories(out);
    REQUIRE(mkfifo((out + "/" + name).c_str(), 0600) == 0);
    const Outcome run = run_program({"run", "-c", config, "-o", out});
    CAPTURE(run.err);
    CHECK(run.code == 1);
    CHECK(contains(run.err, out + "/" + name + ": it is a device, a pipe or a socket"));
    CHECK(fs::is_fifo(out + "/" + name));
  }
}
