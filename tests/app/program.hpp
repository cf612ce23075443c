// SPDX-License-Identifier: Apache-2.0
// Runs the built program as a user does, and keeps its output.
// A Folder is a TemporaryFolder whose paths are texts, for command lines.
#pragma once
#include <sys/types.h>
#include <string>
#include <vector>
#include "contains.hpp"
#include "temporary_folder.hpp"

struct Outcome {
  int code = -1;  // exit code; 128 + signal if a signal ended it
  std::string out, err;
};

class Folder {
 public:
  std::string path(const std::string& name = "") const { return (folder_.path() / name).string(); }
  // Writes a file and returns its path.
  std::string file(const std::string& name, const std::string& text) const {
    return folder_.write(name, text).string();
  }
  size_t entries() const;

 private:
  wavetracer::test::TemporaryFolder folder_;
};

// Returns an empty text if the file cannot be read.
std::string contents(const std::string& file);

// Returns 0 if the file cannot be read.
size_t lines_of(const std::string& file);

// A program that is running; wait() collects it.
class Program {
 public:
  // environment: NAME=VALUE texts that override those of this process.
  explicit Program(const std::vector<std::string>& arguments, const std::vector<std::string>& environment = {});
  Outcome wait();
  void signal(int number) const;
  bool ended() const;
  pid_t id() const { return process_; }
  // Returns what it has written to stderr so far.
  std::string messages() const;

 private:
  Folder folder_;
  pid_t process_ = 0;
};

Outcome run_program(const std::vector<std::string>& arguments, const std::vector<std::string>& environment = {});

// Tells whether the program finds an OpenCL device; if not, the test's output says that cases are skipped.
bool device_present();
