// SPDX-License-Identifier: Apache-2.0
// Every end is checked once, at its place in the first frame; receivers of grids are counted, not named. A body around
// both ends of a link is a room, which is normal; a body around one end only gets a warning.
#include "simulation/place_warnings.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "radio/constants.hpp"
#include "simulation/few.hpp"
#include "simulation/place_finder.hpp"
#include "simulation/receiver_grid.hpp"

namespace wavetracer {
namespace {

// An end this far outside of the scene's box, in its longest sides, is no longer near the scene.
constexpr double outside_share = 0.05, above_share = 1;

enum Kind { inside, below, outside, on_surface, near, kinds };
constexpr std::array<const char*, kinds> words = {"inside closed bodies", "below the ground",
                                                  "outside of the scene's box", "on a surface",
                                                  "within a wavelength of an end that they are linked to"};

// The findings about an end, one text for each kind; empty: there is none.
using Findings = std::array<std::string, kinds>;

struct EndPlace {
  std::optional<Surroundings::Body> body;
  Findings findings;  // all except those that need a second end
};

EndPlace look(const Surroundings& around, const glm::dvec3& p) {
  EndPlace out;
  const Scene& scene = around.scene();
  const glm::dvec3 size = scene.upper - scene.lower;
  const double longest_m = std::max({size.x, size.y, size.z});
  if (const double m = around.outside_m(p); m > outside_share * longest_m)
    out.findings[outside] = fmt::format("is {:.4g} m outside of the scene's box", m);
  else if (const double up_m = p.z - scene.upper.z; up_m > above_share * longest_m)
    out.findings[outside] = fmt::format("is {:.4g} m above the scene's box", up_m);
  if (const auto depth = around.below_ground(p))
    out.findings[below] =
        fmt::format("is {:.3g} m below the ground there, {}", depth->metres, around.name_of(depth->object));
  else
    out.body = around.body_at(p);
  if (const auto object = around.object_at(p))
    out.findings[on_surface] =
        fmt::format("lies on a surface of {}; because of rounding, the surface may hide it: move it away by 1 mm",
                    around.name_of(*object));
  return out;
}

std::vector<EndPlace> look_at_all(const Surroundings& around, const std::vector<EndState>& ends) {
  std::vector<EndPlace> out(ends.size());
  tbb::parallel_for(size_t{0}, ends.size(), [&](size_t i) { out[i] = look(around, ends[i].position_m); });
  return out;
}

// Findings from links: a body around only one of their ends, ends that almost touch.
class Ends {
 public:
  Ends(const Config& config, const Surroundings& around, const World& world)
      : around_(around),
        world_(world),
        wavelength_m_(speed_of_light_m_s / config.radio.frequency_hz),
        state_(world.state(0)),
        transmitters_(look_at_all(around, state_.transmitters)),
        receivers_(look_at_all(around, state_.receivers)) {
    for (const EndPlace* place : all()) parted_.push_back(place->body && around.small(*place->body));
    for (const Link& link : state_.links) look_at(link);
    name_bodies();
  }

  bool any_link() const { return !state_.links.empty(); }
  const Findings& transmitter(size_t i) const { return transmitters_[i].findings; }
  const Findings& receiver(size_t i) const { return receivers_[i].findings; }

 private:
  std::vector<EndPlace*> all() {
    std::vector<EndPlace*> out;
    for (auto* places : {&transmitters_, &receivers_})
      for (EndPlace& place : *places) out.push_back(&place);
    return out;
  }

  void look_at(const Link& link) {
    EndPlace &tx = transmitters_[link.tx], &rx = receivers_[link.rx];
    const auto body = [](const EndPlace& place) {
      return place.body ? std::optional(place.body->number) : std::nullopt;
    };
    if (body(tx) != body(rx)) parted_[link.tx] = parted_[transmitters_.size() + link.rx] = true;
    const double apart_m = glm::distance(state_.transmitters[link.tx].position_m, state_.receivers[link.rx].position_m);
    // An end that sends and receives has no distance from itself.
    if (apart_m > 0 && apart_m < wavelength_m_ && rx.findings[near].empty())
      rx.findings[near] = fmt::format(
          "is {:.3g} m from transmitter \"{}\", less than a wavelength ({:.3g} m): far fields "
          "do not hold there",
          apart_m, world_.transmitters.ends[link.tx].name, wavelength_m_);
  }

  void name_bodies() {
    const std::vector<EndPlace*> places = all();
    for (size_t i = 0; i < places.size(); ++i)
      if (places[i]->body && parted_[i])
        places[i]->findings[inside] =
            fmt::format("is inside a closed body, {}", around_.name_of(places[i]->body->object));
  }

  const Surroundings& around_;
  const World& world_;
  double wavelength_m_;
  WorldState state_;
  std::vector<EndPlace> transmitters_, receivers_;
  std::vector<bool> parted_;  // for transmitters, then receivers: a body is around this end, but not around all
};

// Returns what to do about an end whose height is configured.
std::string remedy(Kind kind, const RadioEnd& end) {
  if (kind != below) return "";
  return from_ground(end.above) || end.position_wgs84 ? "; give it a height above 0"
                                                      : "; above = \"ground\" lets its height count from the ground";
}

std::string remedy(Kind kind, const ReceiverGridConfig& grid) {
  if (kind != below || grid.vertical()) return "";  // a vertical plane may begin below the ground
  return from_ground(grid.above) || grid.south_west_wgs84 ? "; give it a height_m above 0"
                                                          : "; above = \"ground\" lets height_m count from the ground";
}

void say_named(const Config& config, const Ends& ends, const World& world, Kind kind, std::vector<std::string>& out) {
  Few few(out);
  const auto say = [&](const char* role, size_t of_role, const std::vector<RadioEnd>& all, size_t i,
                       const Findings& findings) {
    if (!findings[kind].empty())
      few.add(fmt::format("{} \"{}\" {}{}", i < of_role ? role : "station", all[i].name, findings[kind],
                          remedy(kind, all[i])));
  };
  const size_t stations = config.stations.size();
  for (size_t i = 0; i < config.transmitters.size() + stations; ++i)
    say("transmitter", config.transmitters.size(), world.transmitters.ends, i, ends.transmitter(i));
  for (size_t i = 0; i < config.receivers.size() + stations; ++i)
    if (world.twins.transmitter_of_receiver[i] == no_end)  // else it was named as a transmitter
      say("receiver", config.receivers.size(), world.receivers.ends, i, ends.receiver(i));
  few.end(fmt::format("other antennas are {}", words[kind]));
}

void say_grids(const Config& config, const Surroundings& around, const Ends& ends, std::vector<std::string>& out) {
  size_t first = config.receivers.size() + config.stations.size();
  PlaceFinder places(config, around.scene());
  for (const ReceiverGridConfig& grid : config.receiver_grids) {
    const GridShape shape = grid_shape(grid, around.scene(), places);
    const size_t count = shape.cells();
    for (int kind = 0; kind < kinds; ++kind) {
      size_t such = 0;
      for (size_t i = first; i < first + count; ++i) such += !ends.receiver(i)[static_cast<size_t>(kind)].empty();
      if (such > 0)
        out.push_back(fmt::format("{} of {} receivers of grid \"{}\" are {}{}",
                                  such == count ? "all" : fmt::format("{}", such), count, grid.name,
                                  words[static_cast<size_t>(kind)], remedy(static_cast<Kind>(kind), grid)));
    }
    first += count;
  }
}

void say_links(const Config& config, const Ends& ends, const World& world, std::vector<std::string>& out) {
  if (!world.links.any_allowed())
    out.push_back(
        fmt::format("no link is computed: [links] allows none between the {} transmitters and the {} receivers; "
                    "look at v2v, v2i, i2i, same_vehicle, transmitters and receivers there",
                    world.transmitters.ends.size(), world.receivers.ends.size()));
  else if (world.clock.frame_count() == 1 && !world.live && !ends.any_link())
    out.push_back(
        fmt::format("no link is computed: no transmitter and receiver that [links] allows come within "
                    "links.max_distance_m = {:g} m of each other",
                    config.links.max_distance_m));
}

}  // namespace

std::vector<std::string> place_warnings(const Config& config, const Surroundings& around, const World& world) {
  std::vector<std::string> out;
  const Ends ends(config, around, world);
  for (int kind = 0; kind < kinds; ++kind) say_named(config, ends, world, static_cast<Kind>(kind), out);
  say_grids(config, around, ends, out);
  for (const MountConfig& mount : config.mounts)
    if (mount.offset_m[2] < 0 && mount.node.empty())
      out.push_back(fmt::format("[[mount]] \"{}\": offset_m is {:.3g} m below the ground under its vehicle", mount.name,
                                -mount.offset_m[2]));
  say_links(config, ends, world, out);
  if (!world.live) {
    std::vector<std::string> vehicles = vehicle_warnings(around, world);
    std::move(vehicles.begin(), vehicles.end(), std::back_inserter(out));
  }
  return out;
}

}  // namespace wavetracer
