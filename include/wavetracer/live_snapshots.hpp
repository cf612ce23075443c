// SPDX-License-Identifier: Apache-2.0
// Channels between points of a simulator that asks about pairs of positions, perhaps of an instant that has passed: the
// positions of all nodes are kept for each instant, and one question to the server answers for all pairs of it.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "wavetracer/live_nodes.hpp"

namespace wavetracer {

// From the coordinates of a simulator to those of the scene: y is negated first, if it grows southwards there, as it
// does in Veins and Artery, and then the offset is added.
struct LiveCoordinates {
  LiveVector offset_m{};
  bool mirror_y = false;
  bool is_front = false;  // positions are those of front bumpers, as those of SUMO, and not the middle

  LiveVector turned(const LiveVector& v) const { return {v[0], mirror_y ? -v[1] : v[1], v[2]}; }
  // ahead: the direction in which the vehicle looks, in the coordinates of the simulator.
  LivePlace place(const LiveVector& at, const LiveVector& velocity, const LiveVector& ahead, double length_m) const {
    const LiveVector way = turned(ahead);
    const double size = std::hypot(way[0], way[1]), back_m = is_front && size > 0 ? length_m / 2 : 0;
    LivePlace out{turned(at), turned(velocity), yaw_of(way)};
    for (size_t k = 0; k < 3; ++k) out.position_m[k] += offset_m[k];
    if (back_m > 0)
      for (size_t k = 0; k < 2; ++k) out.position_m[k] -= back_m * way[k] / size;
    return out;
  }
};

// The places of all nodes of a simulator at an instant. All lists have one entry per node.
struct LiveSnapshot {
  double first_s, last_s;  // nothing has moved between these times
  std::vector<LiveNode> nodes;
  std::vector<LivePlace> places;
  std::vector<LiveVector> points;  // the positions by which the simulator asks

  std::optional<size_t> node_at(const LiveVector& point, std::optional<size_t> not_this = {}) const {
    for (size_t k = 0; k < points.size(); ++k)
      if (points[k] == point && k != not_this) return k;
    return {};
  }
  bool is_at(std::optional<double> time_s) const { return !time_s || (*time_s >= first_s && *time_s <= last_s); }
  std::optional<size_t> place_of(const LiveNode& node) const {
    for (size_t k = 0; k < nodes.size(); ++k)
      if (nodes[k] == node) return k;
    return {};
  }
};

// For one thread. All functions that may ask the server throw what LiveClient throws.
class LiveSnapshots {
 public:
  // keep_s: channels stay for this time although nodes move.
  // gain: path_gain_db, narrowband_gain_db or sum_of_powers_db.
  LiveSnapshots(LiveNodes& server, double keep_s, std::string gain)
      : server_(server), keep_s_(keep_s), gain_(std::move(gain)) {}

  // Keeps where all nodes are at this time, which is not before that of the last call. It does not ask the server.
  void take(LiveSnapshot now) {
    if (!entries_.empty()) {
      Entry& last = entries_.back();
      if (last.at.nodes == now.nodes && last.at.points == now.points && last.at.places == now.places) {
        last.at.last_s = now.last_s;
        return;
      }
    }
    std::shared_ptr<Answer> answer;
    if (!entries_.empty() && entries_.back().at.nodes == now.nodes &&
        now.first_s < entries_.back().answer->begin_s + keep_s_)
      answer = entries_.back().answer;
    else
      answer = std::make_shared<Answer>(Answer{now.first_s, {}, {}});
    entries_.push_back({std::move(now), std::move(answer)});
  }
  // Gives up all instants that ended before this time, except the last one.
  void forget_before(double time_s) {
    while (entries_.size() > 1 && entries_.front().at.last_s < time_s) entries_.pop_front();
  }
  size_t size() const { return entries_.size(); }

  // The gain between the nodes that are at these points at this time; without a time, at the last instant that has both
  // points. If a node came only when the other one had begun to send, no instant has both: then the gain between these
  // nodes at the later of the last instants that have one of the points each. -inf if there is no path. Throws
  // std::out_of_range if no such instant is kept.
  double gain_db(const LiveVector& from, const LiveVector& to, std::optional<double> time_s = {}) {
    std::optional<Found> found = at_one_instant(from, to, time_s);
    if (!found) found = at_two_instants(from, to, time_s);
    if (!found)
      throw std::out_of_range("no two nodes are known at " + text(from) + " and " + text(to) +
                              (time_s ? " at " + std::to_string(*time_s) + " s" : std::string()) +
                              ": both ends must be radios of this medium, at the positions of their antennas");
    const Answer& answer = answered(*found->entry);
    const int64_t row = answer.channels->row_with_paths(found->from, found->to);
    return row < 0 ? -std::numeric_limits<double>::infinity() : answer.gain_db[static_cast<size_t>(row)];
  }

 private:
  // Shared by instants for which the same channels are kept.
  struct Answer {
    double begin_s;
    std::optional<LiveNodeChannels> channels;
    std::vector<double> gain_db;  // per link
  };
  struct Entry {
    LiveSnapshot at;
    std::shared_ptr<Answer> answer;
  };

  struct Found {
    Entry* entry;
    size_t from, to;
  };

  std::optional<Found> at_one_instant(const LiveVector& from, const LiveVector& to, std::optional<double> time_s) {
    for (size_t k = entries_.size(); k-- > 0;) {
      const LiveSnapshot& at = entries_[k].at;
      if (!at.is_at(time_s)) continue;
      const std::optional<size_t> a = at.node_at(from), b = at.node_at(to, a);
      if (a && b) return Found{&entries_[k], *a, *b};
    }
    return {};
  }
  std::optional<Found> at_two_instants(const LiveVector& from, const LiveVector& to, std::optional<double> time_s) {
    const std::optional<size_t> one = last_with(from, time_s), other = last_with(to, {});
    if (!one || !other || *one == *other) return {};
    const LiveNode &sender = entries_[*one].at.nodes[*entries_[*one].at.node_at(from)],
                   &receiver = entries_[*other].at.nodes[*entries_[*other].at.node_at(to)];
    Entry& later = entries_[std::max(*one, *other)];
    const std::optional<size_t> a = later.at.place_of(sender), b = later.at.place_of(receiver);
    if (!a || !b || *a == *b) return {};
    return Found{&later, *a, *b};
  }
  std::optional<size_t> last_with(const LiveVector& point, std::optional<double> time_s) const {
    for (size_t k = entries_.size(); k-- > 0;)
      if (entries_[k].at.is_at(time_s) && entries_[k].at.node_at(point)) return k;
    return {};
  }
  const Answer& answered(Entry& entry) {
    Answer& answer = *entry.answer;
    if (!answer.channels) {
      LiveNodeChannels channels = server_.channels(entry.at.first_s, entry.at.nodes, entry.at.places);
      answer.gain_db = channels.channels.link(gain_.c_str());
      answer.channels = std::move(channels);
    }
    return answer;
  }
  static std::string text(const LiveVector& v) {
    return "(" + std::to_string(v[0]) + ", " + std::to_string(v[1]) + ", " + std::to_string(v[2]) + ")";
  }

  LiveNodes& server_;
  double keep_s_;
  std::string gain_;
  std::deque<Entry> entries_;  // by time
};

// The power gain in free space between isotropic antennas, as INET's FreeSpacePathLoss has it: 1 at no distance.
inline double free_space_gain(double wavelength_m, double distance_m) {
  const double ratio = wavelength_m / (4 * 3.14159265358979323846 * distance_m);
  return distance_m == 0 ? 1 : ratio * ratio;
}

}  // namespace wavetracer
