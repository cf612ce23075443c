// SPDX-License-Identifier: Apache-2.0
// Simulates cars that follow one another along lanes and reserve crossings, step by step.
// A vehicle belongs to the lane it came from until its centre has crossed; all braking obeys one limit.
#include "motion/traffic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/split_mix.hpp"
#include "motion/track_motion.hpp"
#include "motion/vehicle_types.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr double acceleration_m_s2 = 2, braking_m_s2 = 3;
constexpr double slowing_m_s2 = 2, sideways_m_s2 = 2.5;  // before turns, and in turns
constexpr double reaction_s = 1;                         // longer than every step, which makes the gaps safe
constexpr double gap_m = 2;                              // between standing vehicles
constexpr double standing_m_s = 0.5;                     // slower than this counts as standing
constexpr double margin_m = 1;                           // between a standing vehicle and a crossing
constexpr double largest_step_s = 0.1;                   // largest step of the simulation; samples may be farther apart
constexpr double warm_up_s = 20;                         // time from standing in the slots to normal traffic
constexpr uint32_t slot_m = 16;  // length of lane in which one vehicle is placed at the beginning
constexpr uint32_t none = 0xFFFFFFFFu;

// Returns the highest speed from which a vehicle can still stop behind one of leader_m_s that brakes now, after its
// reaction time.
double safe_speed_m_s(double free_m, double leader_m_s) {
  constexpr double reaction_m_s = braking_m_s2 * reaction_s;
  return std::sqrt(reaction_m_s * reaction_m_s + leader_m_s * leader_m_s + 2 * braking_m_s2 * std::max(free_m, 0.0)) -
         reaction_m_s;
}

struct Vehicle {
  uint32_t type;
  double length_m, wanted_m_s;
  SplitMix random;  // decides its turns
  uint32_t lane;
  double along_m;  // position of its centre, from the beginning of the lane
  Turn turn = Turn::straight;
  double speed_m_s = 0, next_m_s = 0;
  bool waits = false, admitted = false;  // waits for the crossing ahead, may enter it
  double rear_m() const { return along_m - length_m / 2; }
};

struct Lane {
  std::vector<uint32_t> vehicles;  // the first one first
  uint32_t left_by = none;         // the last vehicle that left this lane, while its rear is still on the crossing
  double left_m = 0;               // the distance that it has driven since the beginning of this lane
};

struct Reservation {
  uint32_t vehicle, lane;
  Turn turn;
};

struct Crossing {
  std::vector<uint32_t> waiting;      // in order of arrival
  std::vector<Reservation> admitted;  // until their rear has left the crossing
};

class Traffic {
 public:
  explicit Traffic(const TrafficOptions& options)
      : streets_(options.grid), lanes_(streets_.lane_count()), crossings_(streets_.crossing_count()) {
    for (const char* name : {"passenger", "delivery", "truck"}) types_.push_back(*sumo_type(name));
    place(options);
  }

  void advance(double step_s) {
    for (Lane& lane : lanes_) ask(lane);
    for (Crossing& crossing : crossings_) admit(crossing);
    for (const Lane& lane : lanes_) follow(lane, step_s);
    for (Vehicle& v : vehicles_) {
      v.along_m += (v.speed_m_s + v.next_m_s) / 2 * step_s;
      v.speed_m_s = v.next_m_s;
    }
    for (Lane& lane : lanes_) hand_on(lane);
    for (Crossing& crossing : crossings_) leave(crossing);
  }

  const std::vector<VehicleType>& types() const { return types_; }
  const std::vector<Vehicle>& vehicles() const { return vehicles_; }
  Sample sample(const Vehicle& v, double time_s) const {
    const Streets::Place place = streets_.at(v.lane, v.turn, v.along_m);
    return {time_s, place.position_m, place.yaw_rad, 0, v.speed_m_s, v.speed_m_s * heading(place.yaw_rad, 0)};
  }

 private:
  // Places vehicles in slots of the lanes, at random.
  void place(const TrafficOptions& options) {
    const uint32_t slots_a_lane = options.grid.block_m / slot_m;
    std::vector<std::pair<uint32_t, uint32_t>> slots;  // lane, slot
    for (uint32_t lane = 0; lane < lanes_.size(); ++lane) {
      if (!streets_.exists(lane)) continue;
      for (uint32_t slot = 0; slot < slots_a_lane; ++slot) slots.emplace_back(lane, slot);
    }
    if (options.vehicles > slots.size()) {
      throw ConfigError(fmt::format("{} vehicles do not fit into the streets of {}x{} blocks, at most {} do",
                                    options.vehicles, options.grid.blocks_x, options.grid.blocks_y, slots.size()));
    }
    SplitMix random(options.seed);
    for (uint32_t i = 0; i < options.vehicles; ++i) {
      std::swap(slots[i], slots[i + random.below(static_cast<uint32_t>(slots.size()) - i)]);
      const uint32_t percent = random.below(100), type = percent < 80 ? 0 : percent < 92 ? 1 : 2;
      const double wanted_m_s = (30 + random.below(31)) / 3.6;
      const double shift_m = random.below(17) / 8.0 - 1;
      const auto [lane, slot] = slots[i];
      vehicles_.push_back(
          {type, types_[type].length_m, wanted_m_s, SplitMix(random.next()), lane, (slot + 0.5) * slot_m + shift_m});
      choose_turn(vehicles_.back());
      lanes_[lane].vehicles.push_back(i);
    }
    for (Lane& lane : lanes_) {
      std::sort(lane.vehicles.begin(), lane.vehicles.end(),
                [&](uint32_t a, uint32_t b) { return vehicles_[a].along_m > vehicles_[b].along_m; });
    }
  }

  void choose_turn(Vehicle& v) const {
    std::vector<Turn> turns;
    for (const Turn turn : {Turn::straight, Turn::straight, Turn::left, Turn::right}) {
      // Straight on is twice as likely.
      if (streets_.exists(streets_.lane_after(v.lane, turn))) turns.push_back(turn);
    }
    v.turn = turns[v.random.below(static_cast<uint32_t>(turns.size()))];
  }

  double way_end_m(const Vehicle& v) const { return streets_.lane_m() + streets_.way_m(v.turn); }
  // Returns the distance from the front of the vehicle to the place where it waits for the crossing.
  double line_ahead_m(const Vehicle& v) const { return streets_.lane_m() - margin_m - v.length_m / 2 - v.along_m; }

  // The first vehicle without a reservation asks for one when it would otherwise have to brake.
  void ask(const Lane& lane) {
    const auto first =
        std::find_if(lane.vehicles.begin(), lane.vehicles.end(), [&](uint32_t i) { return !vehicles_[i].admitted; });
    if (first == lane.vehicles.end()) return;
    Vehicle& v = vehicles_[*first];
    if (v.waits || safe_speed_m_s(line_ahead_m(v), 0) > v.speed_m_s + acceleration_m_s2 * largest_step_s) return;
    v.waits = true;
    crossings_[streets_.crossing_after(v.lane)].waiting.push_back(*first);
  }

  // Vehicles are admitted in order of arrival. A vehicle without room behind the crossing lets the next ones go first,
  // and turns elsewhere once it stands; otherwise vehicles around a block could wait for one another for ever.
  void admit(Crossing& crossing) {
    for (size_t k = 0; k < crossing.waiting.size();) {
      const uint32_t i = crossing.waiting[k];
      Vehicle& v = vehicles_[i];
      const bool free = std::all_of(crossing.admitted.begin(), crossing.admitted.end(), [&](const Reservation& r) {
        return Streets::compatible(v.lane, v.turn, r.lane, r.turn);
      });
      if (!free) return;
      if (room_behind_m(crossing, streets_.lane_after(v.lane, v.turn)) < v.length_m + gap_m + margin_m) {
        if (v.speed_m_s < standing_m_s) choose_turn(v);
        ++k;
        continue;
      }
      v.waits = false;
      v.admitted = true;
      crossing.admitted.push_back({i, v.lane, v.turn});
      crossing.waiting.erase(crossing.waiting.begin() + static_cast<std::ptrdiff_t>(k));
    }
  }

  // Returns the free length at the beginning of the lane if all vehicles stopped that are on it or have a reservation
  // for it.
  double room_behind_m(const Crossing& crossing, uint32_t lane) const {
    const std::vector<uint32_t>& there = lanes_[lane].vehicles;
    double room_m = there.empty() ? streets_.lane_m() : vehicles_[there.back()].rear_m();
    for (const Reservation& r : crossing.admitted) {
      const Vehicle& v = vehicles_[r.vehicle];
      if (v.lane == r.lane && streets_.lane_after(r.lane, r.turn) == lane) room_m -= v.length_m + gap_m;
    }
    return room_m;
  }

  // Computes the next speeds of the vehicles of a lane.
  void follow(const Lane& lane, double step_s) {
    const Vehicle* leader = lane.left_by == none ? nullptr : &vehicles_[lane.left_by];
    double leader_rear_m = leader ? lane.left_m + leader->rear_m() : 0;
    for (const uint32_t i : lane.vehicles) {
      Vehicle& v = vehicles_[i];
      double speed_m_s = std::min({v.wanted_m_s, v.speed_m_s + acceleration_m_s2 * step_s, turn_limit_m_s(v)});
      const double front_m = v.along_m + v.length_m / 2;
      const auto keep_behind = [&](double rear_m, double rear_m_s) {
        speed_m_s = std::min(speed_m_s, safe_speed_m_s(rear_m - front_m - gap_m, rear_m_s));
      };
      if (leader) keep_behind(leader_rear_m, leader->speed_m_s);
      if (v.admitted) {
        const std::vector<uint32_t>& next = lanes_[streets_.lane_after(v.lane, v.turn)].vehicles;
        if (!next.empty()) {
          const Vehicle& last = vehicles_[next.back()];
          keep_behind(way_end_m(v) + last.rear_m(), last.speed_m_s);
        }
      } else {
        speed_m_s = std::min(speed_m_s, safe_speed_m_s(line_ahead_m(v), 0));
      }
      v.next_m_s = speed_m_s;
      leader = &v;
      leader_rear_m = v.rear_m();
    }
  }

  double turn_limit_m_s(const Vehicle& v) const {
    if (v.turn == Turn::straight) return v.wanted_m_s;
    const double ahead_m = std::max(streets_.lane_m() - v.along_m, 0.0);
    return std::sqrt(sideways_m_s2 * streets_.radius_m(v.turn) + 2 * slowing_m_s2 * ahead_m);
  }

  // Moves vehicles that have crossed to the next lane.
  void hand_on(Lane& lane) {
    while (!lane.vehicles.empty()) {
      const uint32_t i = lane.vehicles.front();
      Vehicle& v = vehicles_[i];
      const double end_m = way_end_m(v);
      if (v.along_m < end_m) return;
      lane.vehicles.erase(lane.vehicles.begin());
      lane.left_by = i;
      lane.left_m = end_m;
      v.lane = streets_.lane_after(v.lane, v.turn);
      v.along_m -= end_m;
      v.admitted = false;
      choose_turn(v);
      lanes_[v.lane].vehicles.push_back(i);
    }
  }

  void leave(Crossing& crossing) {
    std::erase_if(crossing.admitted, [&](const Reservation& r) {
      const Vehicle& v = vehicles_[r.vehicle];
      const bool has_left = v.lane != r.lane && v.rear_m() >= 0;
      if (has_left && lanes_[r.lane].left_by == r.vehicle) lanes_[r.lane].left_by = none;
      return has_left;
    });
  }

  Streets streets_;
  std::vector<VehicleType> types_;
  std::vector<Vehicle> vehicles_;
  std::vector<Lane> lanes_;
  std::vector<Crossing> crossings_;
};

}  // namespace

Trajectories generate_traffic(const TrafficOptions& options) {
  const uint64_t steps_a_sample =
      std::max<uint64_t>(1, static_cast<uint64_t>(std::ceil(options.step_s / largest_step_s - 1e-9)));
  const double step_s = options.step_s / static_cast<double>(steps_a_sample);
  const uint64_t samples = 1 + static_cast<uint64_t>(std::floor(options.duration_s / options.step_s + 1e-9));
  Traffic traffic(options);
  for (double time_s = 0; time_s < warm_up_s; time_s += step_s) traffic.advance(step_s);

  Trajectories out;
  out.types = traffic.types();
  for (const Vehicle& v : traffic.vehicles()) {
    out.tracks.push_back({fmt::format("veh{}", out.tracks.size()), v.type, {}, {0}});
    out.tracks.back().samples.reserve(samples);
  }
  for (uint64_t k = 0; k < samples; ++k) {
    const double time_s = static_cast<double>(k) * options.step_s;
    for (size_t i = 0; i < out.tracks.size(); ++i) {
      out.tracks[i].samples.push_back(traffic.sample(traffic.vehicles()[i], time_s));
    }
    for (uint64_t n = 0; n < steps_a_sample; ++n) traffic.advance(step_s);
  }
  set_order(out);
  return out;
}

}  // namespace wavetracer
