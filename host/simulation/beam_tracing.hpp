// SPDX-License-Identifier: Apache-2.0
// Discovery by beams: the sequences of surfaces that an end can see in its mirrors, all of them down to a depth, except
// for beams that are too thin to follow, whose solid angle is told (docs/design/beams.md).
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "passes/beam_gather.hpp"
#include "passes/beam_moving.hpp"
#include "passes/beam_unite.hpp"
#include "passes/beam_visible.hpp"
#include "passes/sequences.hpp"
#include "radio/reflectance_bounds.hpp"
#include "simulation/frame_watch.hpp"
#include "simulation/launch.hpp"

namespace wavetracer {

// The first apertures of beams: the six faces of a cube around each end.
std::vector<wt_aperture> beam_roots(std::span<const Launcher> ends);

struct BeamOptions {
  uint32_t max_transmissions = 0;  // surfaces that are not opaque that a path may pass; each is an interaction too
  uint32_t max_diffractions = 0;   // edges that a path may go over; 0: edges do not diffract
  ReflectanceBounds mirrors;       // those of the surfaces of the world
  // The gain between isotropic antennas below which a path need not be found, and the wavelength that it is for.
  std::optional<double> floor_db = {};
  double wavelength_m = 1;
  // The most memory for beams that are kept; nothing: a quarter of the device's.
  std::optional<uint64_t> most_kept_bytes = {};
};

// The mirrors of the options; floor gets its box of receivers with each discovery.
BeamMirrors make_beam_mirrors(gpu::Context& context, const BeamOptions& options);

// A discovery by beams.
struct BeamTask {
  // Ends that stand, and whose beams over surfaces that do not move may be kept; and all others. Instances hide nothing
  // of such a surface from the former, since exact tests of legs know where they are.
  std::vector<Launcher> standing, moving;
  std::vector<glm::dvec3> receivers = {};  // their places, recentred, m; see BeamOptions::floor_db
  uint32_t max_depth = 0;
  bool keep = false;  // later discoveries are likely to have the same standing ends
};

class BeamTracing {
 public:
  BeamTracing(gpu::Context& context, const Scene& scene, const std::vector<Scene>& models, const BeamOptions& options,
              const FrameWatch* watch = nullptr);
  // Places the instances, before a discovery and whenever they have moved.
  void set_world(const std::vector<Instance>& instances, std::span<const Placement> placements);
  // Enters all sequences of at most max_depth surfaces that these ends see, with every quarter, unless all paths over
  // them to the receivers are too weak. scene: with the surfaces that the triangles name. set: an empty one.
  BeamCounts find(const DeviceScene& scene, const BeamTask& task, Sequences& set);
  // Drops what is kept.
  void forget() { kept_.reset(); }
  // Drops it, and keeps nothing from now on. Returns the warning for the frame that lacked memory.
  std::string keep_nothing();
  // The device memory of what is kept, bytes.
  uint64_t kept_bytes() const { return kept_ ? kept_->bytes() : 0; }

 private:
  // Two kept trees with the same key have the same apertures.
  struct Key {
    std::vector<wt_aperture> roots;
    wt_floor floor;
    uint32_t max_depth;
    bool operator==(const Key& other) const;
  };
  // The beams of standing ends over static surfaces: apertures by depth, where instances may be seen from them, and the
  // set of sequences, in which nodes of apertures are slots.
  struct Kept {
    Key key;
    std::vector<KeptApertures> depths = {};
    gpu::Buffer<uint64_t> table = {};
    gpu::Buffer<uint32_t> quarters = {};
    wt_beam_counters counters{};
    bool any_depth = false;
    uint64_t bytes() const;
  };
  // A walk over all depths.
  struct Walk {
    uint32_t root;               // the node of the tree that it begins at
    const Kept* from = nullptr;  // instances are also looked for from these apertures
    Kept* into = nullptr;        // gets the apertures of each depth
  };

  // Does the discovery; returns false if the set must grow, and all must begin again.
  bool try_find(const DeviceScene& scene, const BeamTask& task, Sequences& set);
  // Enters the sequences of the standing ends over static surfaces, and leaves their tree in kept_, or nothing there if
  // it does not fit. Returns false as above.
  bool find_static(const DeviceScene& scene, const BeamTask& task, Key key, Sequences& set);
  // Enters them from kept_, if this is their tree and the set has room for it.
  bool restore(const Key& key, Sequences& set);
  Key key_of(const BeamTask& task) const;
  // Follows the first `apertures` of lists_.apertures. Returns false as above; any_depth: no beam was left.
  bool follow(const DeviceScene& scene, const BeamTask& task, uint32_t apertures, const Walk& walk, Sequences& set,
              bool& any_depth);
  // Looks through all apertures of a depth.
  bool look(const DeviceScene& scene, uint32_t apertures, const BeamStep& step, Sequences& set);
  // Makes the roots the apertures, with these counters, and returns their number.
  uint32_t start(const std::vector<wt_aperture>& roots, const wt_beam_counters& counters);
  uint64_t limit_bytes() const;

  gpu::Context& context_;
  BeamOptions options_;
  const FrameWatch* watch_;
  WorldFacets facets_;
  BeamTreeBuilder tree_;
  std::optional<BeamGather> gather_;
  std::optional<BeamVisible> visible_;
  std::optional<BeamUnite> unite_;
  std::optional<BeamMoving> moving_;
  uint32_t depth_ = 0;  // the trees of this depth that gather_ can walk
  BeamLists lists_;
  BeamMirrors mirrors_;
  std::unique_ptr<Kept> kept_;
  std::optional<Key> too_large_;  // a tree that did not fit
  BeamCounts counts_;
};

}  // namespace wavetracer
