// SPDX-License-Identifier: Apache-2.0
// Advice for errors about a buffer that is larger than the device allows: it names the keys that its length depends on.
#pragma once

namespace wavetracer::advice {

// Lists of candidates and of paths.
inline constexpr const char* links =
    "Ask for fewer links at a time (links.max_distance_m, links.transmitters, links.receivers; with diffraction a "
    "lower trace.batch_receivers, where frames reuse nothing), lower trace.max_depth, trace.max_diffractions or "
    "trace.diffraction_rays, or choose a device with more memory";
// Lists of discovery by beams.
inline constexpr const char* beams =
    "Lower trace.max_depth, or raise trace.floor_db where it is given; trace.discovery = \"rays\" needs no such list. Or "
    "choose a device with more memory";
inline constexpr const char* tiles =
    "Raise trace.tile_m (twice as long tiles are a quarter as many), or choose a device with more memory";
// Lists of paths over tiles with reflections around them.
inline constexpr const char* points =
    "Lower trace.scattering_reflections, raise trace.tile_m or trace.scattering_floor_db, ask for fewer links at a time "
    "(links.max_distance_m, links.transmitters, links.receivers), or choose a device with more memory";
inline constexpr const char* pieces =
    "Raise target_model.piece_m, make fewer bodies targets (target_model.on), or choose a device with more memory";
// Chains of facets of bodies, and paths by them.
inline constexpr const char* bounces =
    "Lower target_model.bounces, raise target_model.piece_m, make fewer bodies targets (target_model.on), ask for fewer "
    "links at a time (links.max_distance_m, links.transmitters, links.receivers), or choose a device with more memory";
// Lists of paths over targets.
inline constexpr const char* targets =
    "Lower trace.target_reflections, make fewer vehicles targets (target_model.on), ask for fewer links at a time "
    "(links.max_distance_m, links.transmitters, links.receivers), or choose a device with more memory";
inline constexpr const char* scene = "Use a smaller scene, or choose a device with more memory";
inline constexpr const char* spheres =
    "Lower trace.sphere_radius_m or trace.batch_rays, or choose a device with more memory";

}  // namespace wavetracer::advice
