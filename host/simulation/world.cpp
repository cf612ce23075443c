// The world of a configuration: so far the ends that stand in it.
#include "simulation/world.hpp"

#include <algorithm>
#include <cmath>

namespace wavetracer {

struct World::State {
  std::vector<Scene> models;
  std::vector<Instance> instances;
  std::vector<RadioEnd> transmitters, receivers;
  std::vector<std::string> warnings;
  WorldState still;
};

namespace {
std::vector<EndState> states(const std::vector<RadioEnd>& ends, const Scene& scene) {
  std::vector<EndState> out;
  for (const RadioEnd& end : ends) {
    EndState state;
    state.position_m = glm::dvec3(end.position_m[0], end.position_m[1], end.position_m[2]) - scene.origin_m;
    state.velocity_m_s = {end.velocity_m_s[0], end.velocity_m_s[1], end.velocity_m_s[2]};
    out.push_back(state);
  }
  return out;
}
}  // namespace

World::World(const Config& config, const Scene& scene) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.transmitters = config.transmitters;
  s.receivers = config.receivers;
  s.still.transmitters = states(config.transmitters, scene);
  s.still.receivers = states(config.receivers, scene);
  for (uint32_t tx = 0; tx < s.transmitters.size(); ++tx)
    for (uint32_t rx = 0; rx < s.receivers.size(); ++rx) s.still.links.push_back({tx, rx});
}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

const std::vector<Scene>& World::models() const { return state_->models; }
const std::vector<Instance>& World::instances() const { return state_->instances; }
const std::vector<RadioEnd>& World::transmitters() const { return state_->transmitters; }
const std::vector<RadioEnd>& World::receivers() const { return state_->receivers; }
uint64_t World::frame_count() const { return 1; }
double World::time_s(uint64_t) const { return 0; }
WorldState World::state(uint64_t) const { return state_->still; }
const std::vector<std::string>& World::warnings() const { return state_->warnings; }

double World::reach_m() const {
  double reach = 0;
  for (const auto* ends : {&state_->still.transmitters, &state_->still.receivers})
    for (const EndState& end : *ends)
      for (int axis = 0; axis < 3; ++axis) reach = std::max(reach, std::abs(end.position_m[axis]));
  return reach;
}

}  // namespace wavetracer
