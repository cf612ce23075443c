// From visible paths to the rows of a frame, on the device until they are finished: reversed twins and distinct rows in
// their order, then fields, and one read of the columns.
// The reversed twin of a path is that of the link the other way, where both ends send and receive: what is a path one
// way is a path the other way. Assumes that a transmitter and a receiver that are one end stand in the same point.
#pragma once
#include "passes/distinct.hpp"
#include "passes/fields.hpp"
#include "passes/path_groups.hpp"
#include "passes/scan.hpp"
#include "passes/sort.hpp"
#include "passes/vegetation.hpp"
#include "radio/fields.hpp"
#include "simulation/diffracted_paths.hpp"
#include "simulation/frame_account.hpp"
#include "simulation/world.hpp"
#include "wavetracer/path_geometry.hpp"

namespace wavetracer {

class FinishedPaths {
 public:
  // config: with all ends of the world, and the features that are on. Throws ConfigError.
  FinishedPaths(gpu::Context& context, const Scene& scene, const Config& config, const World& world);

  // Starts the passes. visible: solved paths in any order. edges: those of the frame, or nullptr. own: the links whose
  // paths are wanted, where they are not all that ends.links has. carriers: are fields of radio.frequencies_hz wanted,
  // besides those of the first?
  void start(uint32_t frame, const DeviceScene& scene, DiffractedPaths* edges, const RadioEnds& ends,
             const WorldState& world, const SolvedList& visible, const std::vector<Link>* own, bool carriers,
             Counters& counters);
  // Other materials for the frames that follow, at the first carrier: as many as FieldTables has, in its order.
  void set_materials(const std::vector<device::wt_material>& materials) { fields_[0].set_materials(materials); }
  // The paths, once the device has finished, with the counters as it left them; with trace.diffraction they have
  // groups. left_out: gets paths that radio/fields.hpp does not count. carriers: gets the fields that were started
  // besides; may be nullptr.
  Paths take(const wt_counters& counted, LeftOut& left_out, std::vector<CarrierFields>* carriers);
  // Fields::near_edges() of the paths that take() gave, at each carrier.
  std::vector<uint32_t> near_edges() const {
    std::vector<uint32_t> out;
    for (const Fields& fields : fields_) out.push_back(fields.near_edges());
    return out;
  }

 private:
  gpu::Context& context_;
  Distinct distinct_;
  Sort sort_;
  Scan scan_;
  std::optional<Vegetation> vegetation_;  // where the scene has any
  std::vector<Fields> fields_;            // of each carrier, which share nothing but the rows
  std::vector<double> carriers_hz_;
  std::optional<PathGroups> groups_;  // with diffraction
};

// Paths that were found elsewhere as visible ones, instead of those that the list has.
void upload_visible(gpu::Context& context, const PathGeometry& paths, SolvedList& visible);

}  // namespace wavetracer
