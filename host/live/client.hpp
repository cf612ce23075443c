// SPDX-License-Identifier: Apache-2.0
// One connection: it turns bytes into lines and answers into bytes, and has limits of size, rate and time.
// The socket must be non-blocking. This class does not know the meaning of lines.
#pragma once
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "live/solver.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::live {

// The longest line before hello: a token of 4096 characters, each written as \u0000.
inline constexpr size_t hello_bytes = 32768;

class Client {
 public:
  Client(uint64_t number, Descriptor socket, const LiveConfig& limits, Clock::time_point now);

  uint64_t number() const { return number_; }
  int descriptor() const { return *socket_; }

  // Returns the events that poll() should wait for, and the longest wait if the rate limit makes the client wait.
  short events(Clock::time_point now);
  std::optional<Clock::duration> pause(Clock::time_point now);

  // Read from the socket and write to it. If the other end is gone, gone() becomes true.
  void receive();
  void send(Clock::time_point now);
  void hang_up() { gone_ = true; }
  // Returns the next whole line, without its newline, if the client may send a message now. A line that is too long
  // ends the connection; before hello the limit is hello_bytes.
  std::optional<std::string> next_line(Clock::time_point now);

  void say(std::string_view line, Clock::time_point now);
  // Sends the last line; then the socket is closed as soon as the client has read it, or a second later.
  void end(std::string_view line, Clock::time_point now);
  // Ends the connection of a client that took too long.
  void check_time(Clock::time_point now);

  bool ending() const { return ends_at_.has_value(); }
  bool gone() const { return gone_; }
  // There are few enough unread answers to add another one.
  bool has_room() const { return out_.size() - sent_ <= limits_.max_queue_bytes; }
  // All its messages are answered: it is the client's turn.
  bool has_answers() const { return pending.empty() && !reading && !solving; }

  // The hello message of the client, once it was received.
  std::optional<Hello> hello;
  std::shared_ptr<LiveTraffic> traffic = std::make_shared<LiveTraffic>();
  struct Pending {
    FrameMessage message;
    Clock::time_point received;
    std::string refusal;  // not empty: the answer is known already, and waits for those before it
  };
  std::deque<Pending> pending;
  bool reading = false;  // its message is being parsed: the next one waits
  bool solving = false;  // its frame is being solved
  bool leaving = false;  // it has said bye: it gets its answers, but is not read any more
  uint64_t skipped = 0;  // since the last "channels" answer
  unsigned errors = 0;

 private:
  bool may_speak() const;
  bool has_line() const { return in_.find('\n', searched_) != in_.npos; }

  uint64_t number_;
  Descriptor socket_;
  const LiveConfig& limits_;
  std::string in_, out_;
  size_t searched_ = 0, sent_ = 0;  // part of in_ without a newline; part of out_ that was sent
  double allowance_;                // number of messages that the rate limit allows now
  Clock::time_point counted_, connected_, line_began_, spoke_, took_;
  std::optional<Clock::time_point> ends_at_;
  bool finished_ = false;  // the client will send nothing more
  bool shut_ = false;      // and neither will the server
  bool gone_ = false;
};

}  // namespace wavetracer::live
