// The direct line of a link against the static scene and the vehicles of the frame, in double.
// What transmission would bring is known from that line; of the other mechanisms only that they may bring something.
#include "simulation/missing_paths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <iterator>

#include "radio/opacity.hpp"
#include "simulation/few.hpp"
#include "simulation/receiver_grid.hpp"

namespace wavetracer {
namespace {

// A triangle in the way.
struct Obstacle {
  double distance_m;
  std::string name;  // for messages
  const Material* material;
};

class Lines {
 public:
  Lines(const Surroundings& around, const World& world, uint64_t frame)
      : around_(around), world_(world), state_(world.state(frame)) {
    for (const Scene& model : world.models()) models_.emplace_back(model);
  }

  const WorldState& state() const { return state_; }

  // From transmitter to receiver, the nearest first; without the vehicles that carry them.
  std::vector<Obstacle> obstacles(const Link& link) const {
    const EndState &tx = state_.transmitters[link.tx], &rx = state_.receivers[link.rx];
    std::vector<Obstacle> out;
    add(around_, tx.position_m, rx.position_m, "", out);
    for (uint32_t i = 0; i < state_.instances.size(); ++i) {
      const Placement& placed = state_.instances[i];
      if (!placed.present || i == tx.instance || i == rx.instance) continue;
      const auto own = [&](const glm::dvec3& p) { return glm::transpose(placed.rotation) * (p - placed.position_m); };
      add(models_[world_.instances()[i].model], own(tx.position_m), own(rx.position_m),
          fmt::format("vehicle \"{}\"", world_.instances()[i].id), out);
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
  WorldState state_;
  std::vector<Surroundings> models_;
};

// What transmission would do for a line with these obstacles; empty where they are too many or let nothing through.
std::string through_walls(const Config& config, const Features& features, const std::vector<Obstacle>& obstacles) {
  const auto opaque = [&](const Obstacle& o) { return is_opaque(*o.material, config.radio.frequency_hz); };
  if (const auto wall = std::ranges::find_if(obstacles, opaque); wall != obstacles.end()) return {};
  const size_t walls = obstacles.size(), most = std::min(config.trace.max_transmissions, config.trace.max_depth);
  std::string more;
  if (!features.at("transmission").on) more = "trace.transmission = true";
  if (walls > config.trace.max_transmissions)
    more += fmt::format("{}trace.max_transmissions = {}", more.empty() ? "" : " with ", walls);
  if (walls > most && walls > config.trace.max_depth)
    more += fmt::format("{}trace.max_depth = {}", more.empty() ? "" : " and ", walls);
  if (more.empty()) return {};
  return fmt::format("{} lets it through {} wall{}", more, walls, walls == 1 ? "" : "s");
}

// The mechanisms that are off and might lead around what is in the way.
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
  return out;
}

// Links of the frame without those that have a path.
std::vector<Link> missing_links(const Config& config, const World& world, const std::vector<Link>& all,
                                std::span<const Link> found) {
  std::vector<Link> out;
  std::ranges::set_difference(all, found, std::back_inserter(out));
  if (found.empty()) return out;
  std::erase_if(out, [&](const Link& link) {
    return std::ranges::any_of(config.receiver_grids, [&](const ReceiverGridConfig& grid) {
      return grid_cell(grid.name, world.receivers()[link.rx].name).has_value();
    });
  });
  return out;
}

}  // namespace

std::vector<std::string> explain_missing(const Config& config, const Features& features, const Surroundings& around,
                                         const World& world, uint64_t frame, std::span<const Link> found) {
  std::vector<std::string> out;
  const Lines lines(around, world, frame);
  const auto place = [&](const EndState& end) {
    const auto there = around.body_at(end.position_m);
    return std::pair(around.below_ground(end.position_m).has_value(),
                     there ? std::optional(there->number) : std::nullopt);
  };
  Few few(out);
  for (const Link& link : missing_links(config, world, lines.state().links, found)) {
    if (!few.wants_more()) {
      few.skip();
      continue;
    }
    std::string text =
        fmt::format("{} -> {} has no path", world.transmitters()[link.tx].name, world.receivers()[link.rx].name);
    const std::vector<Obstacle> obstacles = lines.obstacles(link);
    if (obstacles.empty()) {
      few.add(text + (config.trace.reception == "sphere" ? ": no ray passed the receiver's sphere, so trace more rays"
                                                         : ", though nothing is on its direct line"));
      continue;
    }
    text += fmt::format(": its direct line meets {} ({}) after {:.4g} m", obstacles[0].name,
                        obstacles[0].material->name, obstacles[0].distance_m);
    const std::string through = through_walls(config, features, obstacles);
    if (!through.empty()) text += "; " + through;
    // Where a body or the ground is around one end alone, nothing but what goes through it gets there.
    const bool parted = place(lines.state().transmitters[link.tx]) != place(lines.state().receivers[link.rx]);
    const std::string beside = parted ? "" : around_walls(config, features, around.scene());
    if (!beside.empty()) text += "; what may lead around it: " + beside;
    few.add(text);
  }
  few.end("more links have no path");
  return out;
}

}  // namespace wavetracer
