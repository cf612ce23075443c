// SPDX-License-Identifier: Apache-2.0
// A client of `wavetracer serve`: poses of vehicles in, channels out as columns; docs/live.md has the protocol.
// It needs C++17, POSIX, nlohmann's json (Debian: nlohmann-json3-dev) and a little-endian machine, and no library.
#pragma once
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "wavetracer/live_socket.hpp"

namespace wavetracer {

struct LiveClientOptions {
  std::string server = "tcp:127.0.0.1:7710";  // or unix:PATH
  std::string token;                          // the secret, if the server asks for one
  std::string detail = "links";               // "links", "paths" or "vertices"
  double timeout_s = 30;                      // the longest wait for one answer, and for a connection
  unsigned retries = 5;                       // number of tries to connect again after a connection was lost
  std::string radar = "none";                 // "detections" or "cubes": answers have the radars of the configuration
};

// The channels of one instant. Columns have one entry per link or per path, the paths of the first link first.
class LiveChannels {
 public:
  // answer: the line of the server with the columns that followed it.
  explicit LiveChannels(nlohmann::json answer) : answer_(std::move(answer)) {
    tx = column<uint32_t>(answer_.at("links").at("tx"));
    rx = column<uint32_t>(answer_.at("links").at("rx"));
    paths = column<uint32_t>(answer_.at("links").at("paths"));
    los = column<uint8_t>(answer_.at("links").at("los"));
    transmitters = answer_.at("transmitters").get<std::vector<std::string>>();
    receivers = answer_.at("receivers").get<std::vector<std::string>>();
    time_s = answer_.at("time_s").get<double>();
  }

  std::vector<std::string> transmitters, receivers;
  std::vector<uint32_t> tx, rx;  // per link: places in these lists
  std::vector<uint32_t> paths;   // per link: how many paths it has
  std::vector<uint8_t> los;      // per link: 1 if one of them has no interaction
  double time_s = 0;

  size_t size() const { return tx.size(); }
  // A figure of each link, such as "path_gain_db"; -inf or NaN where no path arrives.
  std::vector<double> link(const char* name) const { return column<double>(answer_.at("links").at(name)); }
  // With detail "paths": a figure of each path, such as "delay_s". "a": for each path rx_ports * tx_ports pairs of real
  // and imaginary part, receiving port first.
  std::vector<double> path(const char* name) const { return column<double>(answer_.at("paths").at(name)); }
  // All keys that docs/live.md lists, such as "radars" where options asked for them; columns are binary values, which
  // column() reads.
  const nlohmann::json& answer() const { return answer_; }

  // T: double, uint32_t or uint8_t, as the column has it.
  template <class T>
  static std::vector<T> column(const nlohmann::json& value) {
    constexpr uint64_t tag = sizeof(T) == 8 ? 86 : sizeof(T) == 4 ? 70 : 64;
    const nlohmann::json::binary_t& bytes = value.get_binary();
    if (bytes.subtype() != tag) throw std::runtime_error("a column has another type than was asked for");
    std::vector<T> out(bytes.size() / sizeof(T));
    if (!out.empty()) std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
    return out;
  }

 private:
  nlohmann::json answer_;
};

// After a lost connection the client says hello again, sends the last frames of poses, since the server has forgotten
// them, and asks again what was not answered. The first connection is tried once. If the server does not answer in
// time, the client closes the connection and throws LiveError, so a late answer is never taken for that of a later
// question; the next call connects again. A client is for one thread.
class LiveClient {
 public:
  using json = nlohmann::json;

  explicit LiveClient(LiveClientOptions options) : options_(std::move(options)) {
    if (!(options_.timeout_s > 0)) throw std::invalid_argument("timeout_s must be more than 0");
    connect();
  }

  // The server's answer to hello: vehicle types, antennas, limits.
  const json& world() const { return world_; }
  // The number of connections that were made so far.
  unsigned connections() const { return connections_; }

  // The channels of these poses: an array of objects with id, type, position_m, yaw_deg or orientation, and perhaps
  // velocities. more: other keys of a frame, "cold", "detail" and "radar".
  LiveChannels channels(double time_s, json vehicles, json more = json::object()) {
    more.update({{"message", "frame"}, {"time_s", time_s}, {"vehicles", std::move(vehicles)}});
    LiveChannels out = std::move(ask({more})[0]);
    if (frames_.size() == 2) frames_.erase(frames_.begin());
    frames_.push_back(std::move(more));
    return out;
  }
  // The channels at a time between the last two frames of poses.
  LiveChannels at(double time_s) { return std::move(at_each({time_s})[0]); }
  // The same at many times. The questions are sent together, as many as the server lets wait.
  std::vector<LiveChannels> at_each(const std::vector<double>& times_s) {
    std::vector<json> messages;
    for (const double time_s : times_s) messages.push_back({{"message", "at"}, {"time_s", time_s}});
    return ask(messages);
  }
  // Closes the connection; the next question opens it again.
  void close() { socket_.reset(); }

 private:
  // An error message of the server.
  struct Refused {
    bool fatal;
    LiveError error;
  };

  std::vector<LiveChannels> ask(const std::vector<json>& messages) {
    std::vector<LiveChannels> answers;
    std::string lost;
    for (unsigned attempt = 0; attempt <= options_.retries; ++attempt) {
      if (attempt > 0) pause(attempt);
      try {
        if (!socket_) {
          connect();
          std::vector<LiveChannels> known;
          exchange(frames_, known);
        }
        exchange(messages, answers);
        return answers;
      } catch (const LiveConnectionLost& error) {
        lost = error.what();
      } catch (const LiveError& error) {
        if (error.reason() != "no_server") throw;
        lost = error.what();
      }
    }
    throw LiveError("lost", "the connection to the server at " + options_.server + " was lost, and " +
                                std::to_string(options_.retries) +
                                " tries to connect again have failed; the last one: " + lost);
  }
  static void pause(unsigned attempt) {
    std::this_thread::sleep_for(std::chrono::milliseconds(std::min(100u << std::min(attempt - 1, 5u), 2000u)));
  }

  void connect() {
    socket_ = std::make_unique<LiveSocket>(options_.server, options_.timeout_s);
    json hello = {{"message", "hello"}, {"protocol", 1}, {"encoding", "cbor"}, {"detail", options_.detail}};
    if (options_.radar != "none") hello["radar"] = options_.radar;
    if (!options_.token.empty()) hello["token"] = options_.token;
    try {
      socket_->send(hello.dump() + "\n");
      world_ = read("world", nullptr);
    } catch (const LiveConnectionLost& error) {
      close();
      throw LiveError("no_server", "what listens at " + options_.server +
                                       " has closed the connection before it answered hello (" + error.what() +
                                       "): it is no server, or it stops");
    } catch (const Refused& refused) {
      close();
      throw refused.error;
    } catch (...) {
      close();
      throw;
    }
    ++connections_;
  }

  // Appends the answers to the messages that have none yet. Closes the connection where an answer may still come that
  // nobody waits for.
  void exchange(const std::vector<json>& messages, std::vector<LiveChannels>& answers) {
    const size_t first = answers.size(), count = messages.size() - first;
    const size_t window = std::max<size_t>(1, world_.at("limits").at("max_pending_frames").get<size_t>());
    const uint64_t number = last_number_ + 1;
    last_number_ += count;
    size_t sent = 0;
    try {
      for (size_t place = 0; place < count; ++place) {
        for (; sent < std::min(place + window, count); ++sent) {
          json message = messages[first + sent];
          message["frame"] = number + sent;
          socket_->begin();
          socket_->send(message.dump() + "\n");
        }
        socket_->begin();
        answers.push_back(read_channels(number + place));
      }
    } catch (const Refused& refused) {
      if (refused.fatal || answers.size() - first + 1 < sent) close();
      throw refused.error;
    } catch (...) {
      close();
      throw;
    }
  }

  LiveChannels read_channels(uint64_t number) {
    json answer = read("channels", number);
    const std::string columns = socket_->bytes(answer.at("bytes").get<size_t>());
    try {
      answer.update(json::from_cbor(columns, true, true, json::cbor_tag_handler_t::store));
      return LiveChannels(std::move(answer));
    } catch (const std::exception& error) {
      throw LiveError("unreadable", "the server at " + options_.server + " has sent channels that cannot be read (" +
                                        error.what() + "): client and server must have the same version");
    }
  }

  // The next message, which must be the one that is wanted, with the number of the question (null: none).
  json read(const std::string& wanted, const json& number) {
    const std::string line = socket_->line();
    const json answer = json::parse(line, nullptr, false);
    if (!answer.is_object() || !answer.contains("message"))
      throw LiveError("unreadable", "what listens at " + options_.server +
                                        " does not speak the protocol of `wavetracer serve`; it said \"" +
                                        line.substr(0, 60) + "\"");
    const json kind = answer.at("message"), its_number = answer.value("frame", json());
    const bool error = kind == "error", fatal = error && answer.at("fatal") == true;
    if (kind == "bye" || (fatal && answer.at("code") == "timeout"))
      throw LiveConnectionLost(answer.at("text").get<std::string>());
    if (error && (its_number.is_null() || its_number == number)) {
      const std::string code = answer.at("code");
      throw Refused{fatal, LiveError(code, code + ": " + answer.at("text").get<std::string>())};
    }
    if (kind != wanted || its_number != number)
      throw LiveError("stale", "the server at " + options_.server + " has sent " + kind.get<std::string>() + " " +
                                   its_number.dump() + ", but the client has asked for " + wanted + " " +
                                   number.dump() + ": the answer is dropped, and the connection is closed");
    return answer;
  }

  LiveClientOptions options_;
  std::unique_ptr<LiveSocket> socket_;
  json world_;
  std::vector<json> frames_;  // the last two frames of poses: a server that starts again needs them
  uint64_t last_number_ = 0;
  unsigned connections_ = 0;
};

}  // namespace wavetracer
