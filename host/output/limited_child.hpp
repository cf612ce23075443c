// SPDX-License-Identifier: Apache-2.0
// A child process for work that may crash: reading files from elsewhere with a library that damaged files can crash. It
// lives as long as this object, answers one request at a time, and has limits of memory and of time per request. POSIX
// only. The child is a copy of this process by fork(), without its other threads: it must use no device, and no library
// that another thread may be using.
#pragma once
#include <sys/types.h>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace wavetracer {

struct ChildLimits {
  uint64_t bytes = uint64_t{2} << 30;  // bytes of memory beyond those of this process when the child began
  int seconds = 60;                    // processor time for one request, or for each file of a request
};

class LimitedChild {
 public:
  // Sends data back to the parent while a request is answered.
  class Reply {
   public:
    Reply(int socket, int seconds) : socket_(socket), seconds_(seconds) {}
    void send(const void* data, size_t bytes);
    // Names the file that is read from now on, for the error if the child ends.
    void at_file(const std::string& file);

   private:
    int socket_, seconds_;
  };
  // Runs in the child; request() rethrows its exceptions in the parent.
  using Answer = std::function<void(std::string_view request, Reply& reply)>;
  // Returns the memory for the next bytes of an answer.
  using Room = std::function<void*(size_t bytes)>;

  // file: the name in the error if the child ends. Throws RuntimeError if no process can be started.
  LimitedChild(std::string file, Answer answer, ChildLimits limits = {});
  ~LimitedChild();
  LimitedChild(const LimitedChild&) = delete;
  LimitedChild& operator=(const LimitedChild&) = delete;

  // Throws the exception of the answer (InputError or RuntimeError), or InputError that names the file if the child has
  // ended, in this request or an earlier one.
  void request(std::string_view request, const Room& room);
  std::string request(std::string_view request);

 private:
  [[noreturn]] void fail();
  void receive_data(uint64_t bytes, const Room& room);

  std::string file_;
  ChildLimits limits_;
  std::string end_;  // message about the end of the child; empty while it lives
  pid_t process_ = -1;
  int socket_ = -1;
};

}  // namespace wavetracer
