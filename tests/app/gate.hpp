// SPDX-License-Identifier: Apache-2.0
// Gates at which processes of the program wait for the test (see gate.cpp), so that the order of events does not depend
// on speed.
#pragma once
#include <sys/types.h>
#include <functional>
#include <string>
#include <vector>
#include "program.hpp"

class Gate {
 public:
  // Returns the environment of programs that must wait before a file gets a name with `at` in it, and without `but` if
  // that is given.
  std::vector<std::string> at_name(const std::string& at, const std::string& but = "") const;
  // Waits come before a folder is synced.
  std::vector<std::string> at_sync() const;
  // Waits come before each launch of a kernel beyond those that let_launch() allows.
  std::vector<std::string> at_launches() const;
  // Nothing waits, but there is no memory for buffers of more bytes.
  std::vector<std::string> at_buffers(size_t bytes) const;

  // Returns once this many processes wait; fails the test after one minute.
  std::vector<pid_t> wait_for(size_t processes) const;
  void open() const;
  // Allows `more` launches, and returns once the program waits for permission to launch another one, or has ended.
  void let_launch(long more, const Program& program);

 private:
  Folder folder_;
  long launches_ = 0;
  std::vector<pid_t> waiting() const;
  std::vector<std::string> with(std::vector<std::string> settings) const;
};

// Polls until the condition holds; fails the test after one minute, with this description.
void wait_until(const char* what, const std::function<bool()>& holds);

// Waits until the process has handled an interrupt: the program removes its handler then.
void wait_until_interrupted(pid_t process);
