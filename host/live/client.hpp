// One connection: bytes to lines, answers to bytes, and its limits in size, rate and time.
// Assumes a socket that never blocks. Knows nothing of what lines mean.
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

// The longest line before hello was said: a token of 4096 characters, each written as \u0000.
inline constexpr size_t hello_bytes = 32768;

class Client {
 public:
  Client(uint64_t number, Descriptor socket, const LiveConfig& limits, Clock::time_point now);

  uint64_t number() const { return number_; }
  int descriptor() const { return *socket_; }

  // What poll() is to wait for, and for how long at most where the rate makes the client wait.
  short events(Clock::time_point now);
  std::optional<Clock::duration> pause(Clock::time_point now);

  // Bytes from the socket and to it. Without one left to talk to, gone() becomes true.
  void receive();
  void send(Clock::time_point now);
  void hang_up() { gone_ = true; }
  // The next whole line, without its newline, where the client may say something now. One that is too long ends the
  // connection; before hello that is one of more than hello_bytes.
  std::optional<std::string> next_line(Clock::time_point now);

  void say(std::string_view line, Clock::time_point now);
  // The last line; then the socket is closed as soon as it is read, or a second later.
  void end(std::string_view line, Clock::time_point now);
  // Ends the connection of a client that took too long.
  void check_time(Clock::time_point now);

  bool ending() const { return ends_at_.has_value(); }
  bool gone() const { return gone_; }
  // Answers unread are few enough for another one.
  bool has_room() const { return out_.size() - sent_ <= limits_.max_queue_bytes; }
  // Nothing of what it has asked for waits for its answer: it is the client's turn.
  bool has_answers() const { return pending.empty() && !reading && !solving; }

  // What the server knows of the client.
  std::optional<Hello> hello;
  std::shared_ptr<LiveTraffic> traffic = std::make_shared<LiveTraffic>();
  struct Pending {
    FrameMessage message;
    Clock::time_point received;
    std::string refusal;  // not empty: the answer is there already, and waits for those before it
  };
  std::deque<Pending> pending;
  bool reading = false;  // its message is with the parser: the next one waits
  bool solving = false;  // its frame is with the solver
  bool leaving = false;  // it has said bye: it gets its answers, and nothing more is read
  uint64_t skipped = 0;  // since the last channels
  unsigned errors = 0;

 private:
  bool may_speak() const;
  bool has_line() const { return in_.find('\n', searched_) != in_.npos; }

  uint64_t number_;
  Descriptor socket_;
  const LiveConfig& limits_;
  std::string in_, out_;
  size_t searched_ = 0, sent_ = 0;  // of in_: has no newline; of out_
  double allowance_;                // messages that the rate allows now
  Clock::time_point counted_, connected_, line_began_, spoke_, took_;
  std::optional<Clock::time_point> ends_at_;
  bool finished_ = false;  // the client has said all it will
  bool shut_ = false;      // so have we
  bool gone_ = false;
};

}  // namespace wavetracer::live
