// SPDX-License-Identifier: Apache-2.0
// The order of answers is that of datagrams, and one source never waits for more than the frame of another one.
#include "live/van3twin_server.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "radio/links.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::live::van3twin {
namespace {

constexpr int most_lines_per_second = 10;  // about clients, in the log
constexpr std::chrono::milliseconds longest_pause{100}, quiet{1};
constexpr std::chrono::seconds silent_before_replaced{10};
constexpr int datagrams_a_round = 1000;  // then the server looks whether it is to stop

std::string key_of(const std::string& tx, const std::string& rx) { return tx + "\n" + rx; }

}  // namespace

Server::Server(Simulation& simulation, const DatagramSocket& socket, const Options& options, Log log,
               FrameSolved solved)
    : simulation_(simulation),
      socket_(socket),
      options_(options),
      log_(log),
      of_clients_(std::move(log), most_lines_per_second),
      solved_(std::move(solved)) {}

void Server::run(const std::function<bool()>& stop) {
  while (!stop()) {
    of_clients_.catch_up(Clock::now());
    Source* const ahead = due();
    if (!socket_.wait(ahead ? quiet : longest_pause)) {
      if (ahead) solve(*ahead);
      frames_ahead_ += ahead != nullptr;
      continue;
    }
    for (int k = 0; k < datagrams_a_round; ++k) {
      const std::optional<Datagram> datagram = socket_.receive(most_bytes);
      if (!datagram) break;
      const std::string answer = handle(*datagram);
      if (!answer.empty() && !socket_.send(datagram->sender, answer))
        of_clients_.say(fmt::format("client {}: an answer could not be sent", datagram->sender.name()), Clock::now());
    }
  }
  of_clients_.finish();
  log_(fmt::format("{} frames were computed, {} of them before they were asked for", frames_, frames_ahead_));
  if (not_understood_ > 0)
    log_(fmt::format("{} datagrams were no messages of the protocol, and had no answer", not_understood_));
  if (turned_away_ > 0)
    log_(fmt::format("{} datagrams of further clients had no answer: live.max_clients is {}", turned_away_,
                     simulation_.config().live.max_clients));
}

std::string Server::handle(const Datagram& datagram) {
  const std::optional<Message> message = parse(datagram.bytes);
  if (!message || (!options_.peer.empty() && datagram.sender.host() != options_.peer)) {
    if (not_understood_++ == 0)
      log_(fmt::format(
          "client {}: a datagram of {} bytes has no answer: it is no message of the protocol, or comes from "
          "another address than --peer; more of them are counted in silence",
          datagram.sender.name(), datagram.bytes.size()));
    return {};
  }
  if (const auto* update = std::get_if<LocationUpdate>(&*message)) return locate(datagram, *update);
  if (const auto* question = std::get_if<Question>(&*message)) return tell(datagram, *question);
  forget(datagram.sender);
  return {};
}

std::string Server::locate(const Datagram& datagram, const LocationUpdate& update) {
  Source* const source = admit(datagram.sender);
  if (!source) return {};
  const Traffic::Placed placed = source->traffic.update(update);
  if (placed != Traffic::Placed::yes && !source->told) {
    source->told = true;
    of_clients_.say(
        fmt::format(
            "warning: client {}: vehicle {} is left out, since {}; its links have no path. More of them are left "
            "out in silence",
            source->name, update.id,
            placed == Traffic::Placed::no_place ? "all places are taken (count of [[live_vehicle]])"
                                                : "it is outside of the scene (--offset, live.margin_m)"),
        Clock::now());
  }
  return confirmation(update);
}

std::string Server::tell(const Datagram& datagram, const Question& question) {
  if (is_about_origin(question)) return answer(question, {});
  Source* const source = find(datagram.sender);
  if (!source) return answer(question, Link{});
  if (source->traffic.has_changed()) solve(*source);
  source->asked = true;
  const auto found =
      source->links.find(key_of(source->traffic.transmitter(question.from), source->traffic.receiver(question.to)));
  return answer(question, found == source->links.end() ? Link{} : found->second);
}

Server::Source* Server::due() const {
  const auto found = std::ranges::find_if(sources_, [](const auto& each) {
    const Source& source = *each.second;
    return source.asked && source.traffic.has_changed() && source.traffic.round_is_whole();
  });
  return found == sources_.end() ? nullptr : found->second.get();
}

Server::Source* Server::find(const SocketAddress& address) {
  const auto found = sources_.find(address);
  if (found == sources_.end()) return nullptr;
  found->second->spoke = Clock::now();
  return found->second.get();
}

Server::Source* Server::admit(const SocketAddress& address) {
  if (Source* const known = find(address)) return known;
  const Clock::time_point now = Clock::now();
  if (sources_.size() >= simulation_.config().live.max_clients) {
    const auto oldest = std::ranges::min_element(sources_, {}, [](const auto& s) { return s.second->spoke; });
    if (now - oldest->second->spoke < silent_before_replaced) {
      if (turned_away_++ == 0)
        log_(fmt::format("client {} has no answers: {} clients are there already (live.max_clients)", address.name(),
                         sources_.size()));
      return nullptr;
    }
    of_clients_.say(fmt::format("client {} is forgotten: another one came", oldest->second->name), now);
    sources_.erase(oldest);
  }
  auto source = std::make_unique<Source>(
      Source{address.name(), Traffic(simulation_.live_types(), simulation_.live_bounds(), options_.coordinates)});
  source->spoke = now;
  of_clients_.say(fmt::format("client {} came", source->name), now);
  return sources_.emplace(address, std::move(source)).first->second.get();
}

void Server::forget(const SocketAddress& address) {
  const auto found = sources_.find(address);
  if (found == sources_.end()) return;
  of_clients_.say(fmt::format("client {} left", found->second->name), Clock::now());
  sources_.erase(found);
}

// A frame that cannot be computed leaves no links: nothing of an older frame is told.
void Server::solve(Source& source) {
  source.links.clear();
  source.asked = false;
  ++frames_;
  try {
    const std::vector<LivePose> poses = source.traffic.poses();
    const double time_s = std::chrono::duration<double>(Clock::now() - began_).count();
    LiveFrame frame = simulation_.run_poses(source.live, time_s, poses);
    if (solved_) solved_(simulation_, frame);
    const Paths& paths = frame.result.paths;
    size_t row = 0;  // the first path of the link, which is also the first one that arrives
    for (const LinkFigures& link :
         link_figures(paths, frame.result.frame, frame.result.world.links, simulation_.config().radio.frequency_hz)) {
      if (link.paths > 0)
        source.links[key_of(frame.transmitters[link.tx], frame.receivers[link.rx])] = {
            options_.narrowband ? link.narrowband_gain_db : link.path_gain_db, paths.delay_s[row], link.los};
      row += link.paths;
    }
    simulation_.give_back(frame.result);
  } catch (const DeviceError&) {
    throw;
  } catch (const std::exception& error) {
    of_clients_.say(fmt::format("client {}: this frame could not be computed, and its links have no path: {}",
                                source.name, error.what()),
                    Clock::now());
    simulation_.forget();
  }
}

}  // namespace wavetracer::live::van3twin
