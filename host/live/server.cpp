// SPDX-License-Identifier: Apache-2.0
// poll() watches the listener, the solver's eventfd and the clients; then every client with a message is handled. Each
// round looks at all clients, so there should be few.
#include "live/server.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>

#include "live/answer.hpp"
#include "live/token.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::live {
namespace {

constexpr std::chrono::milliseconds longest_wait{100};
constexpr unsigned most_errors = 100;    // errors of a client before it is dropped
constexpr size_t most_turned_away = 16;  // clients that are told at once why they cannot stay
constexpr size_t short_bytes = 16384;    // lines up to this length are read in less than a millisecond

constexpr const char* no_radar =
    "the configuration of this server has no [[radar]]: add one, or leave \"radar\" out of the message";

size_t count_of(const std::vector<LiveType>& types) {
  size_t out = 0;
  for (const LiveType& type : types) out += type.count;
  return out;
}

bool is_stranger(const Client& client) { return !client.ending() && !client.gone() && !client.hello; }
bool is_guest(const Client& client) { return !client.ending() && !client.gone() && client.hello; }

}  // namespace

Server::Server(Simulation& simulation, const Listener& listener, std::string token, Log log, FrameSolved solved)
    : limits_(simulation.config().live),
      radars_(!simulation.config().radars.empty()),
      listener_(listener),
      token_(std::move(token)),
      world_line_(world_line(simulation)),
      places_(count_of(simulation.live_types())),
      log_(std::move(log)),
      solver_(solve_with(simulation, std::move(solved))),
      parser_([this](Line& line) { return parse(line); }) {}

void Server::run(const std::function<bool()>& stop) {
  while (!stop()) {
    const bool knocks = wait(Clock::now());
    const Clock::time_point now = Clock::now();
    take_lines(now);
    take_answer(now);
    for (const auto& client : clients_)
      talk(*client, [&] {
        read(*client, now);
        client->check_time(now);
      });
    std::erase_if(clients_, [&](const auto& client) {
      if (client->gone()) log_(fmt::format("client {} left", client->number()));
      return client->gone();
    });
    if (knocks) accept(now);  // after clients that left have given up their places
    give_next();
  }
  const Clock::time_point now = Clock::now();
  for (const auto& client : clients_) client->end(bye_line("the server stops"), now);
}

// Waits for the first event, and moves bytes. Returns true if a client wants to connect.
bool Server::wait(Clock::time_point now) {
  std::vector<pollfd> polled{
      {listener_.descriptor(), POLLIN, 0}, {solver_.descriptor(), POLLIN, 0}, {parser_.descriptor(), POLLIN, 0}};
  const size_t first = polled.size();
  auto timeout = std::chrono::duration_cast<Clock::duration>(longest_wait);
  for (const auto& client : clients_) {
    polled.push_back({client->descriptor(), client->events(now), 0});
    if (const auto pause = client->pause(now)) timeout = std::min(timeout, *pause);
  }
  const auto milliseconds = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
  if (poll(polled.data(), polled.size(), static_cast<int>(milliseconds)) <= 0) return false;
  const Clock::time_point woken = Clock::now();
  for (size_t i = 0; i < clients_.size(); ++i) {
    const short events = polled[first + i].revents;
    if (events & POLLIN)
      talk(*clients_[i], [&] { clients_[i]->receive(); });
    else if (events & (POLLHUP | POLLERR | POLLNVAL))
      clients_[i]->hang_up();
    if (events & POLLOUT) clients_[i]->send(woken);
  }
  return polled[0].revents != 0;
}

void Server::accept(Clock::time_point now) {
  Descriptor socket = listener_.accept();
  if (*socket < 0) return;
  auto client = std::make_unique<Client>(next_number_++, std::move(socket), limits_, now);
  log_(fmt::format("client {} connected", client->number()));
  if (const size_t guests = count(is_guest); guests >= limits_.max_clients)
    turn_away(*client, "too_many_clients", fmt::format("{} clients are connected already (live.max_clients)", guests),
              now);
  else if (count(is_stranger) >= limits_.max_strangers)
    turn_away(
        **std::ranges::find_if(clients_, [](const auto& c) { return is_stranger(*c); }), "timeout",
        fmt::format("no hello message so far, and others wait: {} connections have sent none (live.max_strangers)",
                    limits_.max_strangers),
        now);
  clients_.push_back(std::move(client));
}

void Server::talk(Client& client, const std::function<void()>& action) const {
  try {
    action();
  } catch (const std::exception& error) {
    log_(fmt::format("client {} is disconnected: {}", client.number(), error.what()));
    client.hang_up();
  }
}

Client* Server::find(uint64_t number) const {
  const auto found = std::ranges::find(clients_, number, [](const auto& c) { return c->number(); });
  return found == clients_.end() ? nullptr : found->get();
}

size_t Server::count(bool (*which)(const Client&)) const {
  return static_cast<size_t>(std::ranges::count_if(clients_, [&](const auto& c) { return which(*c); }));
}

void Server::end(Client& client, std::string_view code, const std::string& text, Clock::time_point now) {
  log_(fmt::format("client {}: {}", client.number(), text));
  client.end(error_line(code, text, {}, true), now);
}

void Server::turn_away(Client& client, std::string_view code, const std::string& text, Clock::time_point now) {
  if (count([](const Client& c) { return c.ending(); }) < most_turned_away)
    end(client, code, text, now);
  else
    client.hang_up();
}

Server::ReadLine Server::parse(const Line& line) const {
  try {
    return {line.client, line.received, parse_message(line.text, places_)};
  } catch (const ProtocolError& error) {
    return {line.client, line.received, error};
  } catch (const std::exception& error) {
    return {line.client, line.received,
            ProtocolError("failed", fmt::format("the message cannot be processed: {}", error.what()))};
  }
}

void Server::read(Client& client, Clock::time_point now) {
  do {
    while (auto text = client.next_line(now)) {
      Line line{client.number(), now, std::move(*text)};
      if (line.text.size() <= short_bytes) {
        handle(client, parse(line), now);
      } else {
        client.reading = true;
        parser_.give(std::move(line));
      }
    }
  } while (flush_refusals(client, now));  // this makes room for more lines
  if (client.leaving && client.has_answers()) client.end(bye_line("goodbye"), now);
}

void Server::take_lines(Clock::time_point now) {
  while (auto line = parser_.take()) {
    Client* const client = find(line->client);
    if (!client) continue;
    client->reading = false;
    if (!client->ending()) talk(*client, [&] { handle(*client, std::move(*line), now); });
  }
}

void Server::handle(Client& client, ReadLine line, Clock::time_point now) {
  if (const auto* error = std::get_if<ProtocolError>(&line.message)) {
    if (client.hello)
      refuse(client, *error, now);
    else
      end(client, error->code, error->what(), now);
    return;
  }
  auto& message = std::get<Message>(line.message);
  if (auto* hello = std::get_if<Hello>(&message)) {
    greet(client, std::move(*hello), now);
  } else if (std::holds_alternative<Bye>(message)) {
    client.leaving = true;  // it leaves once it has its answers (read())
  } else if (!client.hello) {
    end(client, "hello_first", "the first message must be hello", now);
  } else {
    auto& asked = std::get<FrameMessage>(message);
    if (!radars_ && asked.radar.value_or(RadarDetail::none) != RadarDetail::none) {
      ProtocolError error("no_radar", no_radar);
      error.frame = asked.frame;
      return refuse(client, error, now);
    }
    queue(client, std::move(asked), line.received);
  }
}

void Server::greet(Client& client, Hello hello, Clock::time_point now) {
  if (client.hello) return refuse(client, {"unexpected", "hello was received already"}, now);
  if (hello.protocol != protocol_version)
    return end(client, "protocol",
               fmt::format("protocol {} is not supported; this server supports {}", hello.protocol, protocol_version),
               now);
  if (!token_.empty() && !same_token(token_, hello.token))
    return end(client, "token", "hello must contain the token of this server", now);
  if (const size_t guests = count(is_guest); guests >= limits_.max_clients)
    return end(client, "too_many_clients", fmt::format("{} clients are connected already (live.max_clients)", guests),
               now);
  if (!radars_ && hello.radar != RadarDetail::none) return end(client, "no_radar", no_radar, now);
  client.hello = std::move(hello);
  client.hello->token.clear();
  client.say(world_line_, now);
}

// A frame of a free-running client replaces the waiting one, and also forgets earlier results if that one was to do so.
// A frame for a time between frames ("at") neither replaces a frame nor is replaced.
void Server::queue(Client& client, FrameMessage message, Clock::time_point received) {
  if (client.hello->free_running && !message.between) {
    const auto older = std::ranges::find_if(client.pending, [](const auto& p) { return !p.message.between; });
    if (older != client.pending.end()) {
      ++client.skipped;
      message.cold = message.cold || older->message.cold;
      *older = {std::move(message), received, {}};
      return;
    }
  }
  client.pending.push_back({std::move(message), received, {}});
}

// Answers, including refusals, come in the order of frames; a free-running client has no such order.
void Server::refuse(Client& client, const ProtocolError& error, Clock::time_point now) {
  if (++client.errors >= most_errors) {
    flush_refusals(client, now);
    return end(client, "too_many_errors", fmt::format("{} messages had errors", most_errors), now);
  }
  std::string line = error_line(error.code, error.what(), error.frame, false);
  if (client.hello->free_running)
    client.say(line, now);
  else
    client.pending.push_back({{}, now, std::move(line)});
}

bool Server::flush_refusals(Client& client, Clock::time_point now) {
  const size_t before = client.pending.size();
  while (!client.solving && !client.pending.empty() && !client.pending.front().refusal.empty()) {
    client.say(client.pending.front().refusal, now);
    client.pending.pop_front();
  }
  return client.pending.size() < before;
}

void Server::take_answer(Clock::time_point now) {
  const std::optional<Answer> answer = solver_.take();
  if (!answer) return;
  if (!answer->failure.empty()) log_(fmt::format("client {}: {}", answer->client, answer->failure));
  if (Client* const client = find(answer->client)) {
    client->solving = false;
    client->skipped += answer->untold;
    talk(*client, [&] { client->say(answer->line, now); });
  }
  if (!answer->fatal) return;
  for (const auto& client : clients_) client->end(bye_line("the device failed, and the server stops"), now);
  throw DeviceError("the device failed: " + answer->failure);
}

// Takes turns: the first client after the last one served that has a frame and room for its answer.
void Server::give_next() {
  if (!solver_.idle()) return;
  const auto ready = [](const auto& c) {
    return !c->ending() && !c->pending.empty() && c->pending.front().refusal.empty() && c->has_room();
  };
  auto next = std::ranges::find_if(clients_, [&](const auto& c) { return c->number() > last_served_ && ready(c); });
  if (next == clients_.end()) next = std::ranges::find_if(clients_, ready);
  if (next == clients_.end()) return;
  Client& client = **next;
  Client::Pending frame = std::move(client.pending.front());
  client.pending.pop_front();
  client.solving = true;
  last_served_ = client.number();
  const Detail detail = frame.message.detail.value_or(client.hello->detail);
  const RadarDetail radar = frame.message.radar.value_or(client.hello->radar);
  solver_.give({client.number(), std::move(frame.message), detail, client.hello->encoding, radar,
                std::exchange(client.skipped, 0), frame.received, client.traffic});
}

}  // namespace wavetracer::live
