// SPDX-License-Identifier: Apache-2.0
// A client of `wavetracer serve` in C++: two cars meet at a crossing, and the channel from one to the other is printed
// at ten instants of every step. It is one file, to be copied into a simulator; it needs nlohmann's json (Debian:
// nlohmann-json3-dev) and C++17.
//
//     g++ -std=c++17 -O2 live_client.cpp -o live_client
//     wavetracer serve -c configs/live.toml &
//     ./live_client [tcp:127.0.0.1:7710 | unix:PATH] [STEPS]
//
// Channels come as columns in CBOR, see "Channels as columns" in docs/live.md. `Server` is all that a simulator needs.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

using nlohmann::json;

// The elements of a column: float64 as double, uint32 as uint32_t, uint8 as uint8_t. It needs a little-endian machine.
template <class T>
std::vector<T> column(const json& value) {
  constexpr uint64_t tag = sizeof(T) == 8 ? 86 : sizeof(T) == 4 ? 70 : 64;
  const json::binary_t& bytes = value.get_binary();
  if (bytes.subtype() != tag) throw std::runtime_error("a column has another type than was asked for");
  std::vector<T> out(bytes.size() / sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

class Server {
 public:
  // name: tcp:ADDRESS:PORT or unix:PATH. hello: more keys of the first message, such as "detail" or "token".
  explicit Server(const std::string& name, json hello = json::object()) {
    if (name.rfind("unix:", 0) == 0)
      connect_unix(name.substr(5));
    else if (name.rfind("tcp:", 0) == 0)
      connect_tcp(name.substr(4));
    else
      throw std::runtime_error(name + " is neither tcp:ADDRESS:PORT nor unix:PATH");
    hello.update({{"message", "hello"}, {"protocol", 1}, {"encoding", "cbor"}});
    world_ = ask(hello);
  }
  ~Server() { close(socket_); }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  const json& world() const { return world_; }
  // The channels of these poses, an array of objects with id, type, position_m and yaw_deg or orientation.
  json channels(double time_s, json vehicles) {
    return ask({{"message", "frame"}, {"frame", ++frames_}, {"time_s", time_s}, {"vehicles", std::move(vehicles)}});
  }
  // The same at a time between the last two frames of poses.
  json at(double time_s) { return ask({{"message", "at"}, {"frame", ++frames_}, {"time_s", time_s}}); }

 private:
  json ask(const json& message) {
    send(message.dump() + "\n");
    json answer = json::parse(line());
    if (answer.at("message") == "error") throw std::runtime_error(answer.at("text").get<std::string>());
    if (answer.contains("bytes")) {
      const std::string columns = bytes(answer.at("bytes").get<size_t>());
      answer.update(json::from_cbor(columns, true, true, json::cbor_tag_handler_t::store));
    }
    return answer;
  }

  void open(int family) {
    socket_ = ::socket(family, SOCK_STREAM, 0);
    if (socket_ < 0) throw std::system_error(errno, std::generic_category(), "socket");
  }
  void connect_to(const void* address, size_t size, const std::string& name) {
    if (::connect(socket_, static_cast<const sockaddr*>(address), static_cast<socklen_t>(size)) == 0) return;
    const std::string why = std::strerror(errno);
    close(socket_);
    throw std::runtime_error("no server answers at " + name + " (" + why +
                             "); this starts one: wavetracer serve -c configs/live.toml --listen " + name);
  }
  void connect_unix(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof address.sun_path) throw std::runtime_error(path + " is too long for a Unix socket");
    std::memcpy(address.sun_path, path.data(), path.size());
    open(AF_UNIX);
    connect_to(&address, sizeof address, "unix:" + path);
  }
  void connect_tcp(const std::string& name) {
    const size_t colon = name.rfind(':');
    sockaddr_in address{};
    address.sin_family = AF_INET;
    if (colon == name.npos || inet_pton(AF_INET, name.substr(0, colon).c_str(), &address.sin_addr) != 1)
      throw std::runtime_error(name + " is not ADDRESS:PORT with an IPv4 address");
    address.sin_port = htons(static_cast<uint16_t>(std::stoul(name.substr(colon + 1))));
    open(AF_INET);
    connect_to(&address, sizeof address, "tcp:" + name);
    const int on = 1;  // each answer is waited for: do not collect small packets
    setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  }

  void send(const std::string& text) {
    for (size_t done = 0; done < text.size();) {
      const ssize_t sent = ::send(socket_, text.data() + done, text.size() - done, MSG_NOSIGNAL);
      if (sent < 0) throw std::system_error(errno, std::generic_category(), "send");
      done += static_cast<size_t>(sent);
    }
  }
  void receive() {
    char part[65536];
    const ssize_t got = recv(socket_, part, sizeof part, 0);
    if (got <= 0) throw std::runtime_error("the server has closed the connection");
    received_.append(part, static_cast<size_t>(got));
  }
  std::string bytes(size_t count) {
    while (received_.size() < count) receive();
    std::string out = received_.substr(0, count);
    received_.erase(0, count);
    return out;
  }
  std::string line() {
    size_t end;
    while ((end = received_.find('\n')) == received_.npos) receive();
    return bytes(end + 1);
  }

  int socket_ = -1;
  std::string received_;
  json world_;
  uint64_t frames_ = 0;
};

// The strongest path of the first link that has paths.
void print_strongest(const json& answer) {
  const json &links = answer.at("links"), &paths = answer.at("paths");
  const auto tx = column<uint32_t>(links.at("tx")), rx = column<uint32_t>(links.at("rx"));
  const auto counts = column<uint32_t>(links.at("paths"));
  const auto gain_db = column<double>(paths.at("gain_db")), delay_s = column<double>(paths.at("delay_s"));
  const auto doppler_hz = column<double>(paths.at("doppler_hz"));
  for (size_t link = 0, first = 0; link < counts.size(); first += counts[link++]) {
    if (counts[link] == 0) continue;
    size_t best = first;
    for (size_t row = first; row < first + counts[link]; ++row)
      if (gain_db[row] > gain_db[best]) best = row;
    std::printf("%.3f s: %s -> %s: %u paths, the strongest has %.3f dB, %.3f ns, %.2f Hz\n",
                answer.at("time_s").get<double>(), answer.at("transmitters")[tx[link]].get<std::string>().c_str(),
                answer.at("receivers")[rx[link]].get<std::string>().c_str(), counts[link], gain_db[best],
                1e9 * delay_s[best], doppler_hz[best]);
    return;
  }
  std::printf("%.3f s: no link has a path\n", answer.at("time_s").get<double>());
}

int main(int argc, char** argv) try {
  const double step_s = 0.1, speed_m_s = 14;
  const int steps = argc > 2 ? std::stoi(argv[2]) : 5, instants = 10;
  Server server(argc > 1 ? argv[1] : "tcp:127.0.0.1:7710", {{"detail", "paths"}});
  std::printf("%s on %s\n", server.world().at("server").get<std::string>().c_str(),
              server.world().at("device").get<std::string>().c_str());
  for (int step = 0; step < steps; ++step) {
    const double from_s = (step - 1) * step_s, to_s = step * step_s, way_m = speed_m_s * to_s;
    const json east = {{"id", "eastwards"},
                       {"type", "passenger"},
                       {"position_m", {-60 + way_m, -3, 0}},
                       {"yaw_deg", 0},
                       {"velocity_m_s", {speed_m_s, 0, 0}}};
    const json north = {{"id", "northwards"},
                        {"type", "passenger"},
                        {"position_m", {3, -60 + way_m, 0}},
                        {"yaw_deg", 90},
                        {"velocity_m_s", {0, speed_m_s, 0}}};
    const json answer = server.channels(to_s, json::array({east, north}));
    if (step == 0) print_strongest(answer);
    for (int k = 1; step > 0 && k <= instants; ++k)
      print_strongest(server.at(std::min(to_s, from_s + k * (to_s - from_s) / instants)));
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "live_client: %s\n", error.what());
  return 1;
}
