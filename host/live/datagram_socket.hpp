// SPDX-License-Identifier: Apache-2.0
// A UDP socket that listens: datagrams in, with the addresses of their senders, and answers out.
#pragma once
#include <sys/socket.h>

#include <chrono>
#include <compare>
#include <optional>
#include <string>
#include <vector>

#include "live/endpoint.hpp"

namespace wavetracer::live {

// The address and port of a sender, as the system writes them.
struct SocketAddress {
  std::vector<unsigned char> bytes;
  auto operator<=>(const SocketAddress&) const = default;
  // ADDRESS, and ADDRESS:PORT.
  std::string host() const;
  std::string name() const;
};

struct Datagram {
  SocketAddress sender;
  std::string bytes;
};

class DatagramSocket {
 public:
  // endpoint: one with `datagrams`. Throws RuntimeError if the system reports an error.
  explicit DatagramSocket(const Endpoint& endpoint);
  DatagramSocket(const DatagramSocket&) = delete;
  DatagramSocket& operator=(const DatagramSocket&) = delete;

  std::string name() const { return name_; }  // with the real port if port 0 was asked for
  // Waits for a datagram for at most this time. A datagram above most_bytes comes as its first most_bytes + 1.
  bool wait(std::chrono::milliseconds longest) const;
  std::optional<Datagram> receive(size_t most_bytes) const;
  // Returns false if the system could not send it.
  bool send(const SocketAddress& to, const std::string& bytes) const;

 private:
  Descriptor socket_;
  std::string name_;
};

}  // namespace wavetracer::live
