// SPDX-License-Identifier: Apache-2.0
// The program `wavetracer serve` as a process of its own, and connections to it by both protocols. It needs POSIX.
#pragma once
#include <sys/types.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "live_world.hpp"
#include "temporary_folder.hpp"

namespace wavetracer::bench {

// A running server, which ends with the object.
class LiveServer {
 public:
  // Throws RuntimeError with the server's messages if it does not start.
  LiveServer(const LiveOptions& options, const std::string& config);
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  // The address after "unix:", or after "udp:".
  const std::string& address() const { return address_; }
  std::string log() const;

 private:
  test::TemporaryFolder folder_;
  pid_t process_ = 0;
  std::string address_;
};

// A connection by the protocol of docs/live.md.
class LiveStream {
 public:
  LiveStream(const LiveServer& server, const LiveOptions& options);  // says hello
  ~LiveStream();
  LiveStream(const LiveStream&) = delete;
  LiveStream& operator=(const LiveStream&) = delete;

  // Returns the answering line, without parsing it as JSON, and the columns that follow it.
  std::string exchange(const std::string& line) const;
  // Returns the line alone, or the bytes that follow it.
  static std::string_view line_of(std::string_view answer) { return answer.substr(0, answer.find('\n')); }
  static std::string_view columns_of(std::string_view answer) { return answer.substr(answer.find('\n') + 1); }
  nlohmann::json ask(const std::string& line) const;
  static nlohmann::json checked(nlohmann::json answer);

  std::string device;

 private:
  // The number of bytes that follow the line is in its first 200 bytes.
  static bool is_whole(const std::string& in);

  const LiveServer& server_;
  int socket_ = -1;
};

// A client of VaN3Twin's protocol: one datagram, then its answer.
class LiveDatagrams {
 public:
  explicit LiveDatagrams(const LiveServer& server);
  ~LiveDatagrams();
  LiveDatagrams(const LiveDatagrams&) = delete;
  LiveDatagrams& operator=(const LiveDatagrams&) = delete;

  // Returns the text of the answer after its beginning, for example "CALC_DONE_PATHGAIN:". Throws RuntimeError if none
  // comes within 30 s, or another one.
  std::string ask(const std::string& message, std::string_view beginning) const;

 private:
  const LiveServer& server_;
  int socket_ = -1;
};

}  // namespace wavetracer::bench
