// SPDX-License-Identifier: Apache-2.0
// The place where a server listens: unix:PATH, tcp:ADDRESS:PORT or udp:ADDRESS:PORT, with numeric addresses, so that no
// name server is asked. It uses POSIX sockets. Descriptors are closed on exec and are non-blocking.
#pragma once
#include <netdb.h>

#include <memory>
#include <string>
#include <utility>

namespace wavetracer::live {

// A file descriptor that is closed with its owner; -1 if there is none.
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
  bool datagrams = false;  // udp
  std::string path;        // path of a Unix socket
  std::string host, port;  // for TCP and UDP; the host is an IPv4 or IPv6 address
  bool loopback = false;   // only programs on this machine can connect
};

// Throws ConfigError.
Endpoint parse_endpoint(const std::string& text);

using Addresses = std::unique_ptr<addrinfo, void (*)(addrinfo*)>;
// Returns the address to bind to for TCP or UDP. Throws ConfigError.
Addresses resolve(const Endpoint& endpoint);

// Listens while it exists. A Unix socket is a file of mode 0600, removed at the end; the socket of a dead server is
// replaced, but no other file is.
class Listener {
 public:
  // Throws ConfigError if the path is taken, RuntimeError if the system reports an error.
  explicit Listener(const Endpoint& endpoint);
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  int descriptor() const { return *socket_; }
  std::string name() const { return name_; }  // with the real port if port 0 was asked for
  // Returns a new connection, or none if nobody is waiting any more or no descriptor is left.
  Descriptor accept() const;

 private:
  void listen_unix(const std::string& path);
  void listen_tcp(const Endpoint& endpoint);

  Descriptor socket_;
  std::string name_, file_;
  unsigned long long device_ = 0, inode_ = 0;  // identify the file that this object made
};

}  // namespace wavetracer::live
