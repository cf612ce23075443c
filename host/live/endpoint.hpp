// Where a server listens: unix:PATH or tcp:ADDRESS:PORT, addresses as numbers, so that no name server is asked.
// Assumes POSIX sockets. Descriptors are closed on exec, and never block.
#pragma once
#include <string>
#include <utility>

namespace wavetracer::live {

// A file descriptor that is closed with its owner; -1: none.
class Descriptor {
 public:
  explicit Descriptor(int value = -1) : value_(value) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  int operator*() const { return value_; }

 private:
  int value_;
};

struct Endpoint {
  bool unix_socket = false;
  std::string path;        // of a Unix socket
  std::string host, port;  // of TCP; the host is an IPv4 or IPv6 address
  bool loopback = false;   // nobody beyond this machine can connect
};

// Throws ConfigError.
Endpoint parse_endpoint(const std::string& text);

// Listens while it lives. A Unix socket is a file of mode 0600, removed at the end; that of a server that is dead is
// replaced, and nothing else ever is.
class Listener {
 public:
  // Throws ConfigError where the path is taken, RuntimeError where the system says no.
  explicit Listener(const Endpoint& endpoint);
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  int descriptor() const { return *socket_; }
  std::string name() const { return name_; }  // with the port that was given for port 0
  // A new connection; none where nobody waits any more, or no descriptor is left.
  Descriptor accept() const;

 private:
  void listen_unix(const std::string& path);
  void listen_tcp(const Endpoint& endpoint);

  Descriptor socket_;
  std::string name_, file_;
  unsigned long long device_ = 0, inode_ = 0;  // of the file that this made
};

}  // namespace wavetracer::live
