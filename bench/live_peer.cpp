// SPDX-License-Identifier: Apache-2.0
#include "live_peer.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>

#include "wavetracer/error.hpp"

extern char** environ;

namespace wavetracer::bench {
namespace {

// Reads a line; an incomplete one if the writer ends.
std::string read_line(int descriptor) {
  std::string out;
  for (char c = 0; read(descriptor, &c, 1) == 1 && c != '\n';) out += c;
  return out;
}

}  // namespace

LiveServer::LiveServer(const LiveOptions& options, const std::string& config) {
  const std::string file = folder_.write("live.toml", config), socket = "unix:" + (folder_ / "socket");
  std::vector<std::string> words{
      options.program, "serve", "-c", file, "--listen", options.datagrams() ? "udp:127.0.0.1:0" : socket};
  if (options.datagrams()) words.insert(words.end(), {"--protocol", "van3twin", "--position", "middle"});
  if (!options.device.empty()) words.insert(words.end(), {"--device", options.device});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw RuntimeError("no pipe can be made: raise ulimit -n");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (folder_ / "log").c_str(), O_WRONLY | O_CREAT, 0600);
  const int failed = posix_spawn(&process_, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  const std::string line = failed ? "" : read_line(ends[0]);
  close(ends[0]);
  if (failed) throw RuntimeError(fmt::format("cannot start {}; --program names it", words[0]));
  constexpr std::string_view beginning = "listening on ";
  const size_t colon = line.find(':');
  if (!line.starts_with(beginning) || colon == line.npos) {
    waitpid(process_, nullptr, 0);
    throw RuntimeError("the server did not start: " + log());
  }
  address_ = line.substr(colon + 1);
}

LiveServer::~LiveServer() {
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
}

std::string LiveServer::log() const {
  std::ifstream in(folder_ / "log");
  return {std::istreambuf_iterator<char>(in), {}};
}

LiveStream::LiveStream(const LiveServer& server, const LiveOptions& options) : server_(server) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  server.address().copy(address.sun_path, sizeof address.sun_path - 1);
  socket_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw RuntimeError("the server does not answer; " + server.log());
  device = ask(fmt::format(R"({{"message":"hello","protocol":1,"detail":"{}","encoding":"{}"}})", options.asked(),
                           options.encoding))
               .at("device");
}

LiveStream::~LiveStream() { close(socket_); }

std::string LiveStream::exchange(const std::string& line) const {
  const std::string out = line + "\n";
  for (size_t sent = 0; sent < out.size();) {
    const ssize_t count = send(socket_, out.data() + sent, out.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) throw RuntimeError("the server went away; " + server_.log());
    sent += static_cast<size_t>(count);
  }
  std::string in;
  do {
    const size_t before = in.size();
    in.resize(before + (1 << 18));
    const ssize_t count = recv(socket_, in.data() + before, in.size() - before, 0);
    if (count <= 0) throw RuntimeError("the server went away; " + server_.log());
    in.resize(before + static_cast<size_t>(count));
  } while (!is_whole(in));
  return in;
}

nlohmann::json LiveStream::ask(const std::string& line) const {
  return checked(nlohmann::json::parse(line_of(exchange(line))));
}

nlohmann::json LiveStream::checked(nlohmann::json answer) {
  if (answer.at("message") == "error") throw RuntimeError(answer.at("text").get<std::string>());
  return answer;
}

bool LiveStream::is_whole(const std::string& in) {
  const size_t end = in.find('\n'), key = in.substr(0, 200).find("\"bytes\":");
  if (end == in.npos) return false;
  return key == in.npos || in.size() == end + 1 + std::stoull(in.substr(key + 8));
}

LiveDatagrams::LiveDatagrams(const LiveServer& server) : server_(server) {
  const size_t colon = server.address().rfind(':');
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<uint16_t>(std::stoul(server.address().substr(colon + 1))));
  inet_pton(AF_INET, server.address().substr(0, colon).c_str(), &address.sin_addr);
  socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const timeval longest{30, 0};
  if (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest) != 0)
    throw RuntimeError("no socket for datagrams can be made");
}

LiveDatagrams::~LiveDatagrams() { close(socket_); }

std::string LiveDatagrams::ask(const std::string& message, std::string_view beginning) const {
  std::array<char, 1024> answer{};
  ssize_t count = send(socket_, message.data(), message.size(), MSG_NOSIGNAL);
  if (count >= 0) count = recv(socket_, answer.data(), answer.size(), 0);
  if (count < 0) throw RuntimeError(fmt::format("{} has no answer; {}", message, server_.log()));
  const std::string_view text(answer.data(), static_cast<size_t>(count));
  if (!text.starts_with(beginning)) throw RuntimeError(fmt::format("{} was answered by {}", message, text));
  return std::string(text.substr(beginning.size()));
}

}  // namespace wavetracer::bench
