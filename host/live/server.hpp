// SPDX-License-Identifier: Apache-2.0
// The protocol: who may send, what is answered, whose frame is solved next. One thread handles sockets, one solves, and
// one reads long messages, so that no client waits for another one's data. The simulation must have [[live_vehicle]],
// and must not be used by other code meanwhile.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "live/client.hpp"
#include "live/endpoint.hpp"
#include "live/solver.hpp"

namespace wavetracer::live {

using Log = std::function<void(const std::string&)>;

class Server {
 public:
  // token: empty if none is needed. solved: as for solve_with().
  Server(Simulation& simulation, const Listener& listener, std::string token, Log log, FrameSolved solved = {});
  // Runs until stop() returns true; it is called ten times per second. Throws DeviceError if the device fails.
  void run(const std::function<bool()>& stop);

 private:
  // A line that is long enough to be read on another thread, and the result.
  struct Line {
    uint64_t client = 0;
    Clock::time_point received;
    std::string text;
  };
  struct ReadLine {
    uint64_t client = 0;
    Clock::time_point received;
    std::variant<Message, ProtocolError> message;
  };

  ReadLine parse(const Line& line) const;
  void accept(Clock::time_point now);
  void read(Client& client, Clock::time_point now);
  void handle(Client& client, ReadLine line, Clock::time_point now);
  void greet(Client& client, Hello hello, Clock::time_point now);
  void queue(Client& client, FrameMessage message, Clock::time_point received);
  void refuse(Client& client, const ProtocolError& error, Clock::time_point now);
  void take_lines(Clock::time_point now);
  void take_answer(Clock::time_point now);
  // An error while talking to a client, such as lack of memory, ends that client alone.
  void talk(Client& client, const std::function<void()>& action) const;
  Client* find(uint64_t number) const;  // null if it has left
  size_t count(bool (*which)(const Client&)) const;
  void give_next();
  // Sends refusals that wait for no frame any more; returns false if there were none.
  bool flush_refusals(Client& client, Clock::time_point now);
  bool wait(Clock::time_point now);
  void end(Client& client, std::string_view code, const std::string& text, Clock::time_point now);
  // Does the same, but silently if many clients are being told already.
  void turn_away(Client& client, std::string_view code, const std::string& text, Clock::time_point now);

  const LiveConfig& limits_;
  bool radars_;  // the configuration has some
  const Listener& listener_;
  std::string token_, world_line_;
  size_t places_ = 0;
  Log log_;
  std::vector<std::unique_ptr<Client>> clients_;
  uint64_t next_number_ = 1, last_served_ = 0;
  Solver solver_;
  Worker<Line, ReadLine> parser_;
};

}  // namespace wavetracer::live
