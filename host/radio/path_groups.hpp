// Groups say which paths of a frame are one wave, and how much of each is (wavetracer/paths.hpp).
// Groups stand for geometrical waves: a path belongs to that of its own steps, and with shares (radio/edge_shares.hpp)
// to those of the same steps with nothing in the place of an edge, or a reflection at one of its faces. A wave need not
// reach the receiver to be the group of those that are diffracted at its boundaries: so nothing jumps where it begins
// to. With several edges the shares of all of them are multiplied.
// Steps are compared by planes, since neighbours in one plane reflect alike, and without transmissions: what is passed
// does not change the way of a wave. A path that is scattered is one with no other.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "radio/edge_shares.hpp"
#include "wavetracer/paths.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

class PathGrouping {
 public:
  // The parts of a world: its static scene, and its instances and their models.
  PathGrouping(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances,
               double frequency_hz);

  // Sets the groups and weights the paths of one frame in their order. state: of that frame. Runs on all cores.
  void operator()(Paths& paths, const WorldState& state) const;

 private:
  struct Key {  // of a wave, and the part of a path that is one with it
    uint64_t hash;
    double weight;
  };
  using Keys = std::vector<Key>;
  struct RowKeys {  // of a path
    std::array<Key, most_groups> keys{};
    size_t count = 0;
    bool bends = false;
  };
  glm::dvec3 origin_m_;
  double wavelength_m_;
  std::vector<wt_wedge> wedges_;                       // as radio/world_records.hpp has them
  std::vector<uint32_t> planes_of_;                    // of each surface of the world: the lowest surface in its plane
  std::vector<uint32_t> first_surface_, first_wedge_;  // of instances

  wt_wedge placed(uint32_t wedge, const WorldState& state) const;
  bool keys_of(const Paths& paths, size_t row, const WorldState& state, Keys& keys, Keys& next) const;
  static void keep_largest(Keys& keys);
  static void number_link(Paths& paths, size_t first, size_t end, const std::vector<RowKeys>& keys);
};

}  // namespace wavetracer
