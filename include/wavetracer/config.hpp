// SPDX-License-Identifier: Apache-2.0
// The configuration of a run, one struct per table of the TOML file. Defaults are defined here, each with its reason
// in the field table (host/config/field_table.cpp), which is what parsing, `validate`, `init` and `--help` are driven
// by. Where the file says 0 or "auto" for "choose yourself" or "no limit", the member is an optional that is not set.
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "wavetracer/cache_config.hpp"
#include "wavetracer/choice.hpp"
#include "wavetracer/live_config.hpp"
#include "wavetracer/material_config.hpp"
#include "wavetracer/order_config.hpp"
#include "wavetracer/outdoors_config.hpp"
#include "wavetracer/radar_config.hpp"
#include "wavetracer/shared_list.hpp"
#include "wavetracer/target_config.hpp"

namespace wavetracer {

using UpAxis = Choice<"auto", "y", "z">;
using ItuEdition = Choice<"P.2040-4", "P.2040-3">;  // edition of Recommendation ITU-R P.2040

struct SceneConfig {
  std::string file;                                   // absolute after parsing (given relative to the config file)
  std::string generate;                               // arguments of `wavetracer scene city`, instead of a file
  double scale = 1;                                   // metres per file unit (OBJ, GLB, PLY)
  UpAxis up = "auto";                                 // auto: y for glTF, else z
  std::map<std::string, std::string> material_alias;  // [scene.material_alias]: name in the file -> radio material
  ItuEdition itu_edition = "P.2040-4";                // edition whose materials are known by name
  bool extrapolate_materials = false;       // use materials beyond the range that they were measured in, with a warning
  std::string default_material;             // for meshes without one; empty: a missing material is an error
  std::optional<double> plane_tolerance_m;  // tolerance of vertices about a plane; empty: by wavelength and file
  std::string streets;                      // a SUMO network, for pictures only
};

// The wavefront across the elements of an array, see wavetracer/arrays.hpp.
using WavefrontShape = Choice<"spherical", "plane">;

struct RadioConfig {
  double frequency_hz = 5.9e9;
  std::vector<double> frequencies_hz = {};  // several carriers, the first of which is frequency_hz; empty: that alone
  WavefrontShape wavefront = "spherical";
  // The link budget; without it there is no received power and no signal-to-noise ratio.
  std::optional<double> transmit_power_dbm, bandwidth_hz;
  double noise_figure_db = 0;
};

// The antenna patterns that are built in (else: a pattern file), and the ports of an antenna.
using NamedAntenna = Choice<"isotropic", "short-dipole", "dipole", "tr38901">;
using Polarization = Choice<"V", "H", "VH", "cross">;
constexpr uint32_t ports_of(Polarization polarization) {
  return polarization == "VH" || polarization == "cross" ? 2 : 1;
}

using HeightAbove = Choice<"zero", "ground">;
constexpr bool from_ground(HeightAbove above) { return above == "ground"; }

struct RadioEnd {  // [[transmitter]], [[receiver]] or [[station]]
  std::string name;
  std::array<double, 3> position_m{0, 0, 0};  // file coordinates
  std::string antenna = "isotropic";          // a NamedAntenna, or a pattern file
  Polarization polarization = "V";
  std::array<double, 3> orientation_deg{0, 0, 0};  // yaw, pitch, roll (intrinsic z, y, x)
  std::array<double, 3> velocity_m_s{0, 0, 0};     // file axes; for Doppler shifts only: the position does not change
  std::string array = {};                          // name of an [[array]]; empty: one element
  // Instead of position_m: latitude and longitude in degrees, and the height above the ground in m.
  std::optional<std::array<double, 3>> position_wgs84 = {};
  HeightAbove above = "zero";  // the reference of the height in position_m
};

// The codebooks that are built in (else: a file).
using NamedCodebook = Choice<"none", "dft">;

struct ArrayConfig {  // [[array]]: the positions of the elements of ends
  std::string name;
  uint32_t rows = 1, columns = 1;  // a panel: rows along z, columns along y of the antenna's axes
  double vertical_spacing_wavelengths = 0.5, horizontal_spacing_wavelengths = 0.5;  // at radio.frequency_hz
  std::optional<double> vertical_spacing_m = {}, horizontal_spacing_m = {};         // alternatives to these
  // Instead of a panel: positions of elements, in the antenna's axes.
  std::vector<std::array<double, 3>> positions_m = {};
  std::string codebook = "none";  // a NamedCodebook, or a codebook file

  bool has_codebook() const { return codebook != "none"; }
};

struct ResponseConfig {                     // [response]: the channel at subcarriers, for all pairs of elements
  std::optional<double> bandwidth_hz = {};  // not given: no responses
  uint32_t subcarriers = 64;                // spacing: bandwidth_hz / subcarriers
  uint32_t times = 1;                       // number of times within a frame, from the frame's own time on
  double time_step_s = 1e-3;
};

struct ReceiverGridConfig {  // [[receiver_grid]]: receivers NAME/IX,IY at the middles of square cells, for coverage
  std::string name;
  std::optional<double> x_min_m, x_max_m, y_min_m, y_max_m;  // file coordinates; not given: those of the scene
  // Alternatives to x_min_m and y_min_m, and to x_max_m and y_max_m: latitude and longitude in degrees.
  std::optional<std::array<double, 2>> south_west_wgs84 = {}, north_east_wgs84 = {};
  // Instead of these borders and of a height, a vertical plane: x, y of its ends, and its lower and upper border in z
  // (not given: those of the scene). IX counts from `from_m`, IY upwards.
  std::optional<std::array<double, 2>> from_m = {}, to_m = {};
  std::optional<double> z_min_m = {}, z_max_m = {};
  double step_m = 5;                    // side of a cell
  std::optional<double> height_m = {};  // not given: default_height_m
  // Instead of height_m: several heights. The reader makes a grid NAME@HEIGHT of each, and leaves this empty.
  std::vector<double> heights_m = {};
  HeightAbove above = "zero";  // zero: height_m is z; ground: above the lowest surface there
  std::string antenna = "isotropic";
  Polarization polarization = "V";
  std::array<double, 3> orientation_deg{0, 0, 0};
  std::string array = {};

  static constexpr double default_height_m = 1.5;
  bool vertical() const { return from_m.has_value(); }
};

// [trajectories]: how vehicles move. Give either file or generate, or [[track]] tables, or nothing: no vehicles.
struct TrajectoriesConfig {
  std::string file;                         // a format of motion/read.hpp
  std::string generate;                     // arguments of `wavetracer scene city` about vehicles, instead of a file
  std::array<double, 3> offset_m{0, 0, 0};  // file coordinates of the scene = scale * those of `file` + offset_m
  double scale = 1;                         // factor of positions in `file`
  HeightAbove above = "zero";  // reference of heights in `file`; for a file in degrees it is always the ground
  bool persons = false, containers = false;
  std::string default_type;  // vehicle type of vehicles whose type is unknown; empty: such a vehicle is an error
};

struct TrackConfig {  // [[track]]: a vehicle on waypoints
  std::string id;
  std::string type = "passenger";
  std::vector<std::array<double, 4>> waypoints;  // time_s, x, y, z; file coordinates of the scene
  // Alternative: time_s, latitude, longitude, m above the ground.
  std::vector<std::array<double, 4>> waypoints_wgs84 = {};
  HeightAbove above = "zero";  // reference of the heights of waypoints
};

struct ParkedConfig {  // [[parked]]: vehicles that stand in all frames
  std::string name;    // the vehicles are called NAME/0, NAME/1, ...
  std::string file;    // CSV with a header that names the columns x, y and optionally z, yaw, type
  std::vector<std::array<double, 4>> places;  // x, y, z, yaw in degrees; file coordinates of the scene
  std::string type = "passenger";             // used where the file names none
  bool mounts = false;                        // true if [[mount]] entries put antennas on them, too
};

// The bodies of vehicles that are built in (else: a mesh file).
using NamedBody = Choice<"auto", "car", "van", "truck", "bus", "tram", "motorcycle", "pedestrian", "none">;

struct VehicleTypeConfig {  // [[vehicle_type]]: the body of a type of the trajectories
  std::string name;
  std::string model = "auto";  // a NamedBody, or a mesh file (x ahead, z up, origin on the ground)
  // Not given: the size of the mesh file, or else of SUMO's vehicle class of this name.
  std::optional<double> length_m = {}, width_m = {}, height_m = {};
  std::string material = "metal";  // radio material of meshes that name none

  bool has_body() const { return model != "none"; }
};

using MountRole = Choice<"transmitter", "receiver", "both">;
constexpr bool sends(MountRole role) { return role != "receiver"; }
constexpr bool receives(MountRole role) { return role != "transmitter"; }

struct MountConfig {     // [[mount]]: an antenna on vehicles
  std::string name;      // the end is called VEHICLE/NAME
  std::string on = "*";  // ids or types of vehicles, * and ? as in shells
  MountRole role = "both";
  std::array<double, 3> offset_m{0, 0, 0};  // from the centre of the footprint, or from the node: ahead, left, up
  std::string node = {};                    // a point of the vehicle's body, by its name; empty: the footprint
  std::string antenna = "isotropic";
  Polarization polarization = "V";
  std::array<double, 3> orientation_deg{0, 0, 0};  // in the vehicle's axes
  std::string array = {};
  HeightAbove above = "zero";  // zero: offset_m[2] is above the vehicle's origin; ground: above the ground of the scene
};

struct LinksConfig {  // [links]: which pairs are computed
  double max_distance_m = std::numeric_limits<double>::infinity();
  std::vector<std::string> transmitters{"*"}, receivers{"*"};  // names of ends, * and ? as in shells
  bool v2v = true, v2i = true, i2i = true;  // vehicle to vehicle; vehicle and infrastructure, either way; ...
  bool same_vehicle = false;                // between two antennas of one vehicle
};

struct TimeConfig {                      // [time]: frames of a drive
  std::optional<double> start_s, end_s;  // not given: those of the trajectories
  std::optional<double> step_s = {};     // not given: that of the trajectories
};

using Directions = Choice<"horizon", "hilbert", "fibonacci", "random">;
// Heights are spread by tables of the slopes that paths can have.
constexpr bool by_slopes(Directions directions) { return directions == "horizon"; }
// Neighbours in the launch are neighbours on a Hilbert curve, whose cells can be split.
constexpr bool along_curve(Directions directions) { return directions == "horizon" || directions == "hilbert"; }
constexpr bool at_random(Directions directions) { return directions == "random"; }

using Reception = Choice<"exact", "sphere">;
// The way that sequences are found: sampled by rays, or followed by beams, which miss none. "auto" becomes one of them
// when the scene is known (host/simulation/feature_choice.hpp).
using DiscoveryWay = Choice<"rays", "beams", "auto">;

struct TraceConfig {
  DiscoveryWay discovery = "rays";
  std::optional<uint64_t> rays = 200000;      // per transmitter; not set ("auto"): what recall needs, at most max_rays
  double recall = 0.99;                       // with rays = "auto": share of the paths to find
  uint64_t max_rays = 10000000;               // with rays = "auto"
  bool reuse = true;                          // sequences of earlier frames of a drive are kept and solved again
  std::optional<uint64_t> refresh_rays = {};  // per transmitter, in a frame that reuses; not given: a tenth of rays
  double discover_every_s = 0;  // time between frames that launch rays, if frames reuse sequences; 0: all launch rays
  uint32_t forget_frames = 50;  // a sequence that no ray has met for this many frames is dropped
  uint32_t max_depth = 5;
  std::optional<double> floor_db = {};  // with discovery = "beams": weaker paths need not be found; not given: all are
  bool reflection = true, diffraction = false, transmission = false, scattering = false;
  bool target = true;                                    // if there are targets
  uint32_t max_diffractions = 1, max_transmissions = 2;  // per path
  std::optional<double> diffraction_floor_db = {};       // gain below which paths over edges are left out; else none is
  // Range below the strongest path of a link without edges; not set ("auto"): config::diffraction_range_of.
  std::optional<double> diffraction_range_db = {};
  bool free_edges = true;                         // edges of one face diffract as half planes
  bool edge_ends = false;                         // a static edge's wave ends with the wave of its corner
  std::optional<uint64_t> diffraction_rays = {};  // per receiver; not given: a tenth of rays, at least 100,000
  // Per edge and prefix that sees it; 0: receivers launch rays; not set ("auto"): config::edge_rays_of.
  std::optional<uint64_t> edge_rays = {};
  double tile_m = 5;                               // largest side length of a tile of scattering
  uint32_t scattering_reflections = 0;             // most before a tile and after it; 0: tiles are seen directly
  bool scattering_diffraction = false;             // one of the interactions around a tile may be an edge
  std::optional<double> scattering_floor_db = {};  // gain below which such paths are left out; not given: none is
  uint32_t target_reflections = 0;                 // most before a target and after it; 0: it is seen directly
  bool target_diffraction = false;                 // one of the interactions on either side may be an edge
  std::optional<double> target_floor_db = {};      // gain below which paths over targets are left out; else none is
  Directions directions = "horizon";
  Reception reception = "exact";
  double sphere_radius_m = 1.0;
  uint64_t seed = 1;
  std::optional<uint64_t> batch_rays = {};       // number of rays traced at once; not given: chosen for the device
  std::optional<uint32_t> batch_receivers = {};  // ray-launching receivers computed at once; not given: 8192 and more

  // Receivers get the rays that pass through their spheres, instead of exact paths.
  bool by_spheres() const { return reception == "sphere"; }
  bool by_beams() const { return discovery == "beams"; }
  bool reflects_scattered() const { return scattering && scattering_reflections > 0; }
  bool reflects_echoes() const { return target && target_reflections > 0; }
  // Do rays start at the edges of diffracted paths? "auto" must have been decided.
  bool from_edges() const { return diffraction && edge_rays.value_or(0) > 0; }
  // Are paths joined from what both of their ends see? Then receivers launch rays, too.
  bool from_both_ends() const { return diffraction || reflects_scattered() || reflects_echoes(); }
};

struct OutputConfig {
  std::string directory = "out";
  uint32_t shard_frames = 100;  // frames per file of a drive; the first of each is cold if frames reuse sequences
  uint64_t waypoints = 0;       // samples per transmitter whose waypoints are written, spread evenly; 0: none
  bool cache_entries = false;   // the entries of the ray cache's table, a row each; needs cache.statistics
  bool paths = true;            // write paths; else the device sums those of each link, and none are read
  bool lifetimes = false;       // compute Paths::lifetime_m
  // Paths that are not written to paths.h5, see output/path_limits.hpp; not given: all are.
  std::optional<double> min_gain_db, dynamic_range_db;
  std::optional<uint32_t> max_paths_per_link = {};
  uint32_t compression = 1;  // compression of HDF5 files: level of deflate, 0: none
  bool keep_shards = false;  // keep the shards of a drive after it is complete and merged
};

struct Config {
  std::string file;  // the TOML file, empty when built in code
  std::string text;  // the whole configuration with --set applied, echoed into the outputs: echoed_config()
  SceneConfig scene;
  RadioConfig radio;
  AirConfig air;
  std::vector<VegetationConfig> vegetation;
  std::vector<MaterialConfig> materials;
  SharedList<RadioEnd> transmitters, receivers;
  std::vector<RadioEnd> stations;  // each of them is a transmitter and a receiver of one name
  std::vector<ReceiverGridConfig> receiver_grids;
  std::vector<ArrayConfig> arrays;
  TrajectoriesConfig trajectories;
  std::vector<TrackConfig> tracks;
  std::vector<ParkedConfig> parked;
  std::vector<VehicleTypeConfig> vehicle_types;
  std::vector<MountConfig> mounts;
  std::vector<TargetModelConfig> target_models;
  std::vector<TargetPartConfig> target_parts;
  std::vector<TargetConfig> targets;
  std::vector<RadarConfig> radars;
  LinksConfig links;
  TimeConfig time;
  std::vector<LiveVehicleConfig> live_vehicles;
  LiveConfig live;
  TraceConfig trace;
  OrderConfig order;
  LaunchConfig launch;
  CacheConfig cache;
  ResponseConfig response;
  OutputConfig output;
};

}  // namespace wavetracer
