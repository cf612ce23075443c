// SPDX-License-Identifier: Apache-2.0
// Compares the direct line of a link with the static scene and the vehicles of the frame, in double. That line shows
// the effect of transmission; the other mechanisms are only known to be possible.
#include "simulation/missing_paths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "radio/opacity.hpp"
#include "simulation/receiver_grid.hpp"

namespace wavetracer {
namespace {

// A triangle that blocks the line.
struct Obstacle {
  double distance_m;
  std::string name;  // for messages
  const Material* material;
};

class Lines {
 public:
  Lines(const Surroundings& around, const World& world, const WorldState& state)
      : around_(around), world_(world), state_(state) {
    for (const Scene& model : world.fleet.models) models_.emplace_back(model);
  }

  // Returns obstacles from transmitter to receiver, the nearest first, without the vehicles that carry them.
  std::vector<Obstacle> obstacles(const Link& link) const {
    const EndState &tx = state_.transmitters[link.tx], &rx = state_.receivers[link.rx];
    std::vector<Obstacle> out;
    add(around_, tx.position_m, rx.position_m, "", out);
    for (uint32_t i = 0; i < state_.instances.size(); ++i) {
      const Placement& placed = state_.instances[i];
      if (!placed.present || i == tx.instance || i == rx.instance) continue;
      const auto own = [&](const glm::dvec3& p) { return glm::transpose(placed.rotation) * (p - placed.position_m); };
      add(models_[world_.fleet.instances[i].model], own(tx.position_m), own(rx.position_m),
          fmt::format("vehicle \"{}\"", world_.fleet.instances[i].id), out);
    }
    std::ranges::stable_sort(out, {}, &Obstacle::distance_m);
    return out;
  }

 private:
  // vehicle: its name for messages; empty: the scene's own objects.
  static void add(const Surroundings& around, const glm::dvec3& a, const glm::dvec3& b, const std::string& vehicle,
                  std::vector<Obstacle>& out) {
    const Scene& scene = around.scene();
    const double length_m = glm::distance(a, b);
    double last_m = -1;
    for (const auto& [distance_m, triangle] : around.crossings(a, b)) {
      if (distance_m <= on_surface_m || distance_m >= length_m - on_surface_m) continue;
      if (distance_m - last_m <= on_surface_m) continue;  // two triangles at their common edge
      last_m = distance_m;
      const uint32_t object = scene.triangle_object[triangle];
      out.push_back({distance_m, vehicle.empty() ? around.name_of(object) : vehicle,
                     &scene.materials[scene.surfaces[scene.triangle_surface[triangle]].material]});
    }
  }

  const Surroundings& around_;
  const World& world_;
  const WorldState& state_;
  std::vector<Surroundings> models_;
};

// The effect of transmission on a line with these obstacles; empty if they are too many or let nothing through.
std::string through_walls(const Config& config, const Features& features, const std::vector<Obstacle>& obstacles) {
  const auto opaque = [&](const Obstacle& o) { return is_opaque(*o.material, config.radio.frequency_hz); };
  if (const auto wall = std::ranges::find_if(obstacles, opaque); wall != obstacles.end()) return {};
  const size_t walls = obstacles.size();
  std::string more;
  if (!features.at("transmission").on) more = "trace.transmission = true";
  if (walls > config.trace.max_transmissions)
    more += fmt::format("{}trace.max_transmissions = {}", more.empty() ? "" : " with ", walls);
  if (walls > config.trace.max_depth) more += fmt::format("{}trace.max_depth = {}", more.empty() ? "" : " and ", walls);
  if (more.empty()) return {};
  return fmt::format("{} lets it through {} wall{}", more, walls, walls == 1 ? "" : "s");
}

// The mechanisms that are off and might lead around the obstacles.
std::string around_walls(const Config& config, const Features& features, const Scene& scene) {
  std::string out;
  const auto add = [&](const std::string& what) { out += (out.empty() ? "" : ", ") + what; };
  const TraceConfig& trace = config.trace;
  if (!trace.reflection) add("trace.reflection = true");
  if (!trace.diffraction && std::ranges::any_of(scene.edges, [](const Edge& edge) { return !edge.flat; }))
    add("trace.diffraction = true");
  if (!trace.scattering && std::ranges::any_of(scene.materials, [](const Material& m) { return m.scattering > 0; }))
    add("trace.scattering = true");
  if (features.at("reflection").on || trace.max_depth == 0)
    add(fmt::format("more than trace.max_depth = {}", trace.max_depth));
  if (trace.floor_db) add(fmt::format("less than trace.floor_db = {}", *trace.floor_db));
  return out;
}

// Is a body or the ground around one of the ends only? Then only waves that go through it get there.
bool parted(const Surroundings& around, const glm::dvec3& a, const glm::dvec3& b) {
  const auto place = [&](const glm::dvec3& p) {
    const auto body = around.body_at(p);
    return std::pair(around.below_ground(p).has_value(), body ? std::optional(body->number) : std::nullopt);
  };
  return place(a) != place(b);
}

}  // namespace

std::vector<Link> links_without_path(const FrameResult& frame) {
  std::vector<Link> out;
  if (frame.summed) {
    for (const LinkFigures& link : frame.summed->links)
      if (link.paths == 0) out.push_back({link.tx, link.rx});
    return out;
  }
  size_t path = 0;  // links and paths are in the same order
  for (const Link& link : frame.world.links) {
    const size_t first = path;
    while (path < frame.paths.size() && Link{frame.paths.tx[path], frame.paths.rx[path]} == link) ++path;
    if (path == first) out.push_back(link);
  }
  return out;
}

MissingLinks explain_missing(const Config& config, const Features& features, const Surroundings& around,
                             const World& world, const FrameResult& frame) {
  MissingLinks out;
  const WorldState& state = frame.world;
  const Lines lines(around, world, state);
  const auto why = [&](const Link& link) {
    std::string text =
        fmt::format("{} -> {} has no path", world.transmitters.ends[link.tx].name, world.receivers.ends[link.rx].name);
    const std::vector<Obstacle> obstacles = lines.obstacles(link);
    if (obstacles.empty())
      return text + (config.trace.by_spheres()
                         ? ": no ray passed through the sphere of the receiver; use more rays (trace.rays)"
                         : ", although nothing blocks its direct line");
    text += fmt::format(": its direct line meets {} ({}) after {:.4g} m", obstacles[0].name,
                        obstacles[0].material->name, obstacles[0].distance_m);
    const std::string through = through_walls(config, features, obstacles);
    if (!through.empty()) text += "; " + through;
    if (parted(around, state.transmitters[link.tx].position_m, state.receivers[link.rx].position_m)) return text;
    const std::string beside = around_walls(config, features, around.scene());
    return beside.empty() ? text : text + "; what may lead around it: " + beside;
  };
  const auto in_grid = [&](uint32_t rx) {
    return std::ranges::any_of(config.receiver_grids, [&](const ReceiverGridConfig& grid) {
      return grid_cell(grid.name, world.receivers.ends[rx].name).has_value();
    });
  };
  for (const Link& link : links_without_path(frame)) {
    const bool cell = in_grid(link.rx);
    std::vector<std::string>& words = cell ? out.why_in_grids : out.why;
    ++(cell ? out.in_grids : out.links);
    if (words.size() < MissingLinks::shown) words.push_back(why(link));
  }
  return out;
}

}  // namespace wavetracer
