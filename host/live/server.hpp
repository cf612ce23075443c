// The protocol: who may speak, what is answered, whose frame is solved next. One thread of sockets, one that solves,
// and one that reads long messages, so that no client waits for what another one has sent. Assumes that the simulation
// has [[live_vehicle]], and is used by nobody else meanwhile.
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
  // token: empty where none is asked for. solved: as for solve_with().
  Server(Simulation& simulation, const Listener& listener, std::string token, Log log, FrameSolved solved = {});
  // Until stop() says so, which is asked ten times per second. Throws DeviceError where the device fails.
  void run(const std::function<bool()>& stop);

 private:
  // A line that is long enough to be read on a thread of its own, and what it was.
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
  // What fails in talking to a client, as for want of memory, is the end of that client alone.
  void talk(Client& client, const std::function<void()>& action) const;
  Client* find(uint64_t number) const;  // null: it has left
  size_t count(bool (*which)(const Client&)) const;
  void give_next();
  // Says the refusals that no frame is before any more; false where there was none.
  bool flush_refusals(Client& client, Clock::time_point now);
  bool wait(Clock::time_point now);
  void end(Client& client, std::string_view code, const std::string& text, Clock::time_point now);
  // The same, without words where many are being told already.
  void turn_away(Client& client, std::string_view code, const std::string& text, Clock::time_point now);

  const LiveConfig& limits_;
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
