// SPDX-License-Identifier: Apache-2.0
#include "live/datagram_socket.hpp"

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>

#include <cerrno>
#include <cstring>

#include "wavetracer/error.hpp"

namespace wavetracer::live {
namespace {

constexpr int receive_bytes = 1 << 20;  // datagrams that wait while a frame is computed

std::string numeric(const SocketAddress& address, bool port) {
  char host[NI_MAXHOST] = "?", service[NI_MAXSERV] = "?";
  getnameinfo(reinterpret_cast<const sockaddr*>(address.bytes.data()), static_cast<socklen_t>(address.bytes.size()),
              host, sizeof host, service, sizeof service, NI_NUMERICHOST | NI_NUMERICSERV | NI_DGRAM);
  if (!port) return host;
  return std::strchr(host, ':') ? fmt::format("[{}]:{}", host, service) : fmt::format("{}:{}", host, service);
}

SocketAddress address_of(const sockaddr_storage& storage, socklen_t size) {
  const auto* first = reinterpret_cast<const unsigned char*>(&storage);
  return {{first, first + size}};
}

}  // namespace

std::string SocketAddress::host() const { return numeric(*this, false); }
std::string SocketAddress::name() const { return numeric(*this, true); }

DatagramSocket::DatagramSocket(const Endpoint& endpoint) {
  const Addresses addresses = resolve(endpoint);
  socket_ = Descriptor(socket(addresses->ai_family, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  setsockopt(*socket_, SOL_SOCKET, SO_RCVBUF, &receive_bytes, sizeof receive_bytes);
  if (bind(*socket_, addresses->ai_addr, addresses->ai_addrlen) != 0)
    throw RuntimeError(fmt::format("--listen udp:{}:{}: {}; choose another port, or 0 for any free one", endpoint.host,
                                   endpoint.port, std::strerror(errno)));
  sockaddr_storage own{};
  socklen_t size = sizeof own;
  getsockname(*socket_, reinterpret_cast<sockaddr*>(&own), &size);
  name_ = "udp:" + address_of(own, size).name();
}

bool DatagramSocket::wait(std::chrono::milliseconds longest) const {
  pollfd waiting{*socket_, POLLIN, 0};
  return poll(&waiting, 1, static_cast<int>(longest.count())) > 0;
}

std::optional<Datagram> DatagramSocket::receive(size_t most_bytes) const {
  std::string bytes(most_bytes + 1, '\0');
  sockaddr_storage sender{};
  socklen_t size = sizeof sender;
  const ssize_t got = recvfrom(*socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&sender), &size);
  if (got < 0) return {};
  bytes.resize(static_cast<size_t>(got));
  return Datagram{address_of(sender, size), std::move(bytes)};
}

bool DatagramSocket::send(const SocketAddress& to, const std::string& bytes) const {
  const auto* address = reinterpret_cast<const sockaddr*>(to.bytes.data());
  return sendto(*socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL, address, static_cast<socklen_t>(to.bytes.size())) >=
         0;
}

}  // namespace wavetracer::live
