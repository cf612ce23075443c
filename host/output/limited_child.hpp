// A child process for work that may fault: reading files from elsewhere with a library that damaged ones make fault.
// It lives as long as this object, answers one request at a time, and has limits: memory, and time for a request.
// POSIX only. The child is a copy of this process by fork(), with none of its threads: it must use no device, and no
// library that another thread may be at work with.
#pragma once
#include <sys/types.h>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace wavetracer {

struct ChildLimits {
  uint64_t bytes = uint64_t{2} << 30;  // of memory, beyond what this process had when the child began
  int seconds = 60;                    // of the processor, for one request, or for each file of one
};

class LimitedChild {
 public:
  // The way back to the parent, while a request is answered.
  class Reply {
   public:
    Reply(int socket, int seconds) : socket_(socket), seconds_(seconds) {}
    void send(const void* data, size_t bytes);
    // The file that is read from now on: it is named if the child ends.
    void at_file(const std::string& file);

   private:
    int socket_, seconds_;
  };
  // Runs in the child; what it throws is thrown by request().
  using Answer = std::function<void(std::string_view request, Reply& reply)>;
  // Where the next bytes of an answer go.
  using Room = std::function<void*(size_t bytes)>;

  // file: what is named if the child ends. Throws RuntimeError where no process can be started.
  LimitedChild(std::string file, Answer answer, ChildLimits limits = {});
  ~LimitedChild();
  LimitedChild(const LimitedChild&) = delete;
  LimitedChild& operator=(const LimitedChild&) = delete;

  // Throws what the answer threw (InputError or RuntimeError), or InputError that names the file where the child has
  // ended: then, and from then on.
  void request(std::string_view request, const Room& room);
  std::string request(std::string_view request);

 private:
  [[noreturn]] void fail();
  void receive_data(uint64_t bytes, const Room& room);

  std::string file_;
  ChildLimits limits_;
  std::string end_;  // how the child ended; empty while it lives
  pid_t process_ = -1;
  int socket_ = -1;
};

}  // namespace wavetracer
