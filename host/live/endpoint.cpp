// SPDX-License-Identifier: Apache-2.0
// Sockets are used as in W. R. Stevens, UNIX Network Programming, vol. 1, chapters 4, 15 and 16.
// A Unix socket is bound under a umask, so that it is private from the first moment.
#include "live/endpoint.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "wavetracer/error.hpp"

namespace wavetracer::live {
namespace {

constexpr int backlog = 64;
constexpr int socket_kind = SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK;

std::string system_error() { return std::strerror(errno); }

sockaddr_un unix_address(const std::string& path) {
  sockaddr_un out{};
  out.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof out.sun_path)
    throw ConfigError(fmt::format("--listen unix:{}: the path of a socket must have 1 to {} bytes; choose another path",
                                  path, sizeof out.sun_path - 1));
  path.copy(out.sun_path, path.size());
  return out;
}

const sockaddr* general(const sockaddr_un& address) { return reinterpret_cast<const sockaddr*>(&address); }

// Removes the socket of a server that is dead. Any other file of that name is kept.
void clear(const std::string& path, const sockaddr_un& address) {
  struct stat status;
  if (lstat(path.c_str(), &status) != 0) return;  // bind() reports problems of the folder
  if (!S_ISSOCK(status.st_mode))
    throw ConfigError(
        fmt::format("--listen unix:{}: a file of this name exists, and it is not a socket; choose another path", path));
  const Descriptor probe(socket(AF_UNIX, socket_kind, 0));
  if (connect(*probe, general(address), sizeof address) == 0 || errno != ECONNREFUSED)
    throw ConfigError(fmt::format(
        "--listen unix:{}: another server uses this path already; choose another path, or stop that server", path));
  unlink(path.c_str());
}

std::string port_of(int socket) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  char port[NI_MAXSERV] = "?";
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0)
    getnameinfo(reinterpret_cast<const sockaddr*>(&address), size, nullptr, 0, port, sizeof port, NI_NUMERICSERV);
  return port;
}

bool is_loopback(const sockaddr& address) {
  if (address.sa_family == AF_INET)
    return (ntohl(reinterpret_cast<const sockaddr_in&>(address).sin_addr.s_addr) >> 24) == 127;
  return IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6&>(address).sin6_addr);
}

}  // namespace

Descriptor::~Descriptor() {
  if (value_ >= 0) close(value_);
}

Addresses resolve(const Endpoint& endpoint) {
  addrinfo hints{};
  hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE;
  hints.ai_socktype = endpoint.datagrams ? SOCK_DGRAM : SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int failed = getaddrinfo(endpoint.host.c_str(), endpoint.port.c_str(), &hints, &found); failed != 0) {
    const char* kind = endpoint.datagrams ? "udp" : "tcp";
    throw ConfigError(
        fmt::format("--listen {0}:{1}:{2}: {3}; give a numeric address and a port from 0 to 65535, "
                    "such as {0}:127.0.0.1:7710 or {0}:[::1]:7710",
                    kind, endpoint.host, endpoint.port, gai_strerror(failed)));
  }
  return {found, freeaddrinfo};
}

Endpoint parse_endpoint(const std::string& text) {
  Endpoint out;
  if (text.starts_with("unix:")) {
    out.unix_socket = out.loopback = true;
    out.path = text.substr(5);
    unix_address(out.path);
    return out;
  }
  const size_t colon = text.rfind(':');
  out.datagrams = text.starts_with("udp:");
  if ((!text.starts_with("tcp:") && !out.datagrams) || colon < 4 || colon + 1 == text.size())
    throw ConfigError(fmt::format("--listen {}: give unix:PATH, tcp:ADDRESS:PORT or udp:ADDRESS:PORT", text));
  out.host = text.substr(4, colon - 4);
  out.port = text.substr(colon + 1);
  if (out.host.size() > 2 && out.host.front() == '[' && out.host.back() == ']')
    out.host = out.host.substr(1, out.host.size() - 2);
  if (out.host == "localhost") out.host = "127.0.0.1";
  if (out.port.find_first_not_of("0123456789") != out.port.npos || out.port.size() > 5 || std::stoi(out.port) > 65535)
    throw ConfigError(fmt::format("--listen {}: the port must be a number from 0 to 65535", text));
  out.loopback = is_loopback(*resolve(out)->ai_addr);
  return out;
}

Listener::Listener(const Endpoint& endpoint) {
  if (endpoint.unix_socket)
    listen_unix(endpoint.path);
  else
    listen_tcp(endpoint);
}

Listener::~Listener() {
  struct stat status;
  if (!file_.empty() && lstat(file_.c_str(), &status) == 0 && status.st_dev == device_ && status.st_ino == inode_)
    unlink(file_.c_str());
}

void Listener::listen_unix(const std::string& path) {
  const std::string file = std::filesystem::absolute(path).string();
  const sockaddr_un address = unix_address(path);
  clear(path, address);
  socket_ = Descriptor(socket(AF_UNIX, socket_kind, 0));
  const mode_t before = umask(0177);
  const bool bound = bind(*socket_, general(address), sizeof address) == 0;
  const std::string problem = system_error();
  umask(before);
  if (!bound || listen(*socket_, backlog) != 0)
    throw RuntimeError(fmt::format("--listen unix:{}: {}", path, bound ? system_error() : problem));
  struct stat status;
  if (lstat(path.c_str(), &status) == 0) {
    device_ = status.st_dev;
    inode_ = status.st_ino;
    file_ = file;
  }
  name_ = "unix:" + path;
}

void Listener::listen_tcp(const Endpoint& endpoint) {
  const Addresses addresses = resolve(endpoint);
  const addrinfo& address = *addresses;
  socket_ = Descriptor(socket(address.ai_family, socket_kind, 0));
  const int on = 1;
  setsockopt(*socket_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);  // a restart need not wait for old connections
  if (bind(*socket_, address.ai_addr, address.ai_addrlen) != 0 || listen(*socket_, backlog) != 0)
    throw RuntimeError(fmt::format("--listen tcp:{}:{}: {}; choose another port, or 0 for any free one", endpoint.host,
                                   endpoint.port, system_error()));
  const bool v6 = address.ai_family == AF_INET6;
  name_ = fmt::format("tcp:{}{}{}:{}", v6 ? "[" : "", endpoint.host, v6 ? "]" : "", port_of(*socket_));
}

Descriptor Listener::accept() const {
  Descriptor out(accept4(*socket_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  const int on = 1;  // answers are sent at once; a Unix socket has no such option, and needs none
  if (*out >= 0) setsockopt(*out, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return out;
}

}  // namespace wavetracer::live
