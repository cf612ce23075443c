// SPDX-License-Identifier: Apache-2.0
// A socket to `wavetracer serve` on which every wait has an end; live_client.hpp is made of it. C++17 and POSIX.
#pragma once
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace wavetracer {

// The server refused a message, or there is no answer. reason(): the code of the server's message, such as
// "out_of_time" (docs/live.md lists them), or "no_server", "no_answer", "lost", "stale" or "unreadable".
class LiveError : public std::runtime_error {
 public:
  LiveError(std::string reason, const std::string& text) : std::runtime_error(text), reason_(std::move(reason)) {}
  const std::string& reason() const noexcept { return reason_; }

 private:
  std::string reason_;
};

// The connection has ended; the client may connect again.
struct LiveConnectionLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A connection: lines out, lines and bytes in. begin() starts the time for the next answer, timeout_s.
class LiveSocket {
 public:
  // server: tcp:ADDRESS:PORT or unix:PATH. Throws LiveError if there is no server, std::invalid_argument if the name is
  // neither.
  LiveSocket(const std::string& server, double timeout_s) : server_(server), timeout_s_(timeout_s) {
    begin();
    const size_t kind = server.find(':'), port = server.rfind(':');
    if (server.compare(0, 5, "unix:") == 0 && server.size() > 5)
      connect_unix(server.substr(5));
    else if (server.compare(0, 4, "tcp:") == 0 && port > kind + 1 && port + 1 < server.size())
      connect_tcp(server.substr(4, port - 4), server.substr(port + 1));
    else
      throw std::invalid_argument("the server \"" + server + "\" is neither tcp:ADDRESS:PORT nor unix:PATH");
  }
  ~LiveSocket() {
    if (socket_ >= 0) ::close(socket_);
  }
  LiveSocket(const LiveSocket&) = delete;
  LiveSocket& operator=(const LiveSocket&) = delete;

  void begin() {
    using std::chrono::duration;
    end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(duration<double>(std::min(timeout_s_, 1e8)));
  }

  void send(const std::string& text) {
    for (size_t done = 0; done < text.size();) {
      const ssize_t sent = ::send(socket_, text.data() + done, text.size() - done, MSG_NOSIGNAL);
      if (sent >= 0)
        done += static_cast<size_t>(sent);
      else if (!may_come(errno))
        throw LiveConnectionLost(words(errno));
      else
        wait(POLLOUT);
    }
  }

  // Returns the next line, with its newline.
  std::string line() {
    size_t end, searched = 0;
    while ((end = received_.find('\n', searched)) == received_.npos) {
      searched = received_.size();
      receive();
    }
    return bytes(end + 1);
  }
  std::string bytes(size_t count) {
    while (received_.size() < count) receive();
    std::string out = received_.substr(0, count);
    received_.erase(0, count);
    return out;
  }

 private:
  using Clock = std::chrono::steady_clock;

  static bool may_come(int code) { return code == EAGAIN || code == EWOULDBLOCK || code == EINTR; }
  static std::string words(int code) { return std::generic_category().message(code); }

  // Waits until the socket is ready. Throws LiveError if the time for the answer is over.
  void wait(short events) const {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end_ - Clock::now()).count();
    pollfd waiting{socket_, events, 0};
    const int ready = left < 0 ? 0 : ::poll(&waiting, 1, static_cast<int>(std::min<long long>(left + 1, 1000000000)));
    if (ready < 0 && errno != EINTR) throw LiveConnectionLost(words(errno));
    if (ready != 0) return;
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%g", timeout_s_);
    throw LiveError("no_answer", "the server at " + server_ + " has not answered within " + seconds +
                                     " s: allow a longer time-out, make its frames faster (trace.max_depth, "
                                     "links.max_distance_m), or look at what it has logged");
  }
  void receive() {
    char part[65536];
    for (;;) {
      const ssize_t got = ::recv(socket_, part, sizeof part, 0);
      if (got > 0) {
        received_.append(part, static_cast<size_t>(got));
        return;
      }
      if (got == 0) throw LiveConnectionLost("the server has closed the connection");
      if (!may_come(errno)) throw LiveConnectionLost(words(errno));
      wait(POLLIN);
    }
  }

  [[noreturn]] void no_server(const std::string& why) const {
    throw LiveError("no_server", "no server answers at " + server_ + " (" + why +
                                     "): start one with `wavetracer serve -c configs/live.toml --listen " + server_ +
                                     "`, or name the address of a server that runs");
  }
  // Returns 0, or the code of the error.
  int try_address(int family, const sockaddr* address, socklen_t size) {
    if (socket_ >= 0) ::close(socket_);
    socket_ = ::socket(family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (socket_ < 0) return errno;
    if (::connect(socket_, address, size) == 0) return 0;
    if (errno != EINPROGRESS && errno != EINTR) return errno;
    try {
      wait(POLLOUT);
    } catch (const LiveError&) {
      return ETIMEDOUT;
    }
    int code = 0;
    socklen_t bytes = sizeof code;
    return getsockopt(socket_, SOL_SOCKET, SO_ERROR, &code, &bytes) == 0 ? code : errno;
  }
  void connect_unix(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof address.sun_path) no_server("the path is too long for a Unix socket");
    std::memcpy(address.sun_path, path.data(), path.size());
    const int code = try_address(AF_UNIX, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    if (code != 0) close_and_say(words(code));
  }
  void connect_tcp(std::string host, const std::string& port) {
    if (host.size() > 1 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
    addrinfo hints{}, *found = nullptr;
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = AI_NUMERICSERV;
    if (const int code = getaddrinfo(host.c_str(), port.c_str(), &hints, &found); code != 0)
      no_server(gai_strerror(code));
    int code = EADDRNOTAVAIL;
    for (const addrinfo* each = found; each && code != 0; each = each->ai_next)
      code = try_address(each->ai_family, each->ai_addr, each->ai_addrlen);
    freeaddrinfo(found);
    if (code != 0) close_and_say(words(code));
    const int on = 1;  // each answer is waited for: small packets must not be collected
    setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  }
  [[noreturn]] void close_and_say(const std::string& why) {
    if (socket_ >= 0) ::close(socket_);
    no_server(why);
  }

  std::string server_, received_;
  double timeout_s_;
  int socket_ = -1;
  Clock::time_point end_;
};

}  // namespace wavetracer
