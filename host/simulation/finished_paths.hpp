// SPDX-License-Identifier: Apache-2.0
// From visible paths to the rows of a frame, on the device until they are finished: reversed twins and distinct rows in
// their order, then fields, and one read of the columns. The reversed twin of a path belongs to the link the other way,
// if both ends send and receive: a path in one direction is also a path in the other. A transmitter and a receiver that
// are one end must be at the same point.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "passes/distinct.hpp"
#include "passes/fields.hpp"
#include "passes/link_floors.hpp"
#include "passes/link_sums.hpp"
#include "passes/path_groups.hpp"
#include "passes/scan.hpp"
#include "passes/sort.hpp"
#include "passes/targets.hpp"
#include "passes/vegetation.hpp"
#include "radio/fields.hpp"
#include "simulation/diffracted_paths.hpp"
#include "simulation/frame_account.hpp"
#include "simulation/world.hpp"
#include "wavetracer/path_geometry.hpp"

namespace wavetracer {

// The rows of paths: those of the first carrier are read by the host, those of all carriers, or none, and links are
// summed.
enum class Rows { first_carrier, all_carriers, summed };

class FinishedPaths {
 public:
  // config: has all ends of the world, and the features that are on. Throws ConfigError.
  FinishedPaths(gpu::Context& context, const Scene& scene, const Config& config, const World& world);

  // Starts the passes. visible: solved paths in any order. edges, targets: those of the frame, or nullptr. own: the
  // links whose paths are wanted, if they are not all of ends.links.
  void start(uint32_t frame, const DeviceScene& scene, DiffractedPaths* edges, const TargetRows* targets,
             const RadioEnds& ends, const WorldState& world, const SolvedList& visible, const std::vector<Link>* own,
             Rows rows, Counters& counters);
  // Returns the floors of links for paths over edges, if there are any. visible: the paths without edges.
  std::optional<LinkLimits> floor_links(const DeviceScene& scene, const RadioEnds& ends, const WorldState& world,
                                        const SolvedList& visible, Counters& counters);
  // LinkFloors::most_left_out in the last frame; 0 without floors.
  double most_left_out() { return link_floors_ ? link_floors_->most_left_out() : 0; }
  // Sets other materials for the next frames, at the first carrier: as many as FieldTables has, in its order.
  void set_materials(const std::vector<device::wt_material>& materials) { fields_[0].set_materials(materials); }
  // Turns the antennas of the ends as they are in this state, for again(); the places of ends are those of the frame.
  void turn_ends(const WorldState& world) { fields_[0].set_ends(world); }
  // Returns the paths, once the device has finished, with the counters as it left them; with trace.diffraction they
  // have groups. left_out: gets the paths that are left out (radio/fields.hpp). carriers: gets the fields at the other
  // carriers, if they were started; may be nullptr.
  Paths take(const wt_counters& counted, LeftOut& left_out, std::vector<CarrierFields>* carriers);
  // Returns the sums of the wanted links, in their order, if they were started. They are there until the next frame.
  std::span<const device::wt_link_sum> take_sums(const wt_counters& counted, LeftOut& left_out);
  // Takes paths that are needed no more: those that take() gives next use their memory.
  void give_room(Paths paths);
  // Chooses rows of the paths that take() gave last, in their order, of which again() computes the fields.
  RowChoice choose(std::span<const uint32_t> rows);
  // Returns the columns of the chosen rows at the first carrier with the materials and turns that were set since. All
  // that start() got by reference, but for the world, must still be there, and unchanged.
  CarrierFields again(const RowChoice& choice);
  // Fields::near_edges() for the paths that take() gave, at each carrier.
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
  std::optional<Vegetation> vegetation_;  // set where the scene has any
  std::vector<Fields> fields_;            // one for each carrier; they only share the rows
  std::vector<double> carriers_hz_;
  std::optional<PathGroups> groups_;  // set with diffraction
  Ports ports_;
  std::optional<LinkFloors> link_floors_;  // set with trace.diffraction_range_db
  std::optional<LinkSums> sums_;           // made where they are first asked for
  gpu::HostMemory host_counters_;
  gpu::Marker counted_;              // the counters have been read, and the waves of groups
  std::optional<FieldInputs> last_;  // those of the last frame; empty if it has no rows

  bool counts_ahead(RowCounts expected) const;
  void begin_count(Counters& counters);
  RowCounts wait_for_counts();
};

// Replaces the visible paths of the list by paths that were found elsewhere.
void upload_visible(gpu::Context& context, const PathGeometry& paths, SolvedList& visible);

}  // namespace wavetracer
