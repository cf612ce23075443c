// Gates at which processes of the program wait for the test (gate.cpp says how), so that what happens next does not
// depend on who is faster.
#pragma once
#include <sys/types.h>
#include <functional>
#include <string>
#include <vector>
#include "program.hpp"

class Gate {
 public:
  // The environment of programs that are to wait: before a file gets a name with `at` in it, and without `but` if that
  // is given.
  std::vector<std::string> at_name(const std::string& at, const std::string& but = "") const;
  // Before a folder is synced.
  std::vector<std::string> at_sync() const;
  // Before each launch of a kernel beyond those that let_launch() allows.
  std::vector<std::string> at_launches() const;
  // No wait, but no memory for buffers of more bytes.
  std::vector<std::string> at_buffers(size_t bytes) const;

  // Returns once so many processes wait; fails the test where one minute is not enough.
  std::vector<pid_t> wait_for(size_t processes) const;
  void open() const;
  // Allows so many launches more, and returns once the program waits for leave to launch another one, or has ended.
  void let_launch(long more, const Program& program);

 private:
  Folder folder_;
  long launches_ = 0;
  std::vector<pid_t> waiting() const;
  std::vector<std::string> with(std::vector<std::string> settings) const;
};

// Polls until it holds; fails the test, with this word of what it waits for, where one minute is not enough.
void wait_until(const char* what, const std::function<bool()>& holds);

// Waits until the process has handled an interrupt: the program takes its handler away then.
void wait_until_interrupted(pid_t process);
