// The configuration of a run, one struct a table of the TOML file. Defaults live here, each with its reason
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

#include "wavetracer/choice.hpp"

namespace wavetracer {

struct MaterialConfig {  // [[material]]: overrides or adds a radio material by name
  std::string name;
  std::optional<double> a, b, c, d;  // ITU-R P.2040 coefficients
  std::optional<double> permittivity, conductivity_s_m;
  std::optional<double> thickness_m;                                          // infinity allowed: a half space
  std::optional<double> scattering, scattering_lobe, scattering_cross_polar;  // see Material
};

using UpAxis = Choice<"auto", "y", "z">;

struct SceneConfig {
  std::string file;                                   // absolute after parsing (given relative to the config file)
  std::string generate;                               // arguments of `wavetracer scene city`, instead of a file
  double scale = 1;                                   // metres a file unit (OBJ, GLB, PLY)
  UpAxis up = "auto";                                 // auto: z, but y for glTF
  std::map<std::string, std::string> material_alias;  // [scene.material_alias]: name in the file -> radio material
  std::string default_material;                       // for meshes without one; empty: a missing material is an error
};

struct RadioConfig {
  double frequency_hz = 5.9e9;
  // The link budget; not given: no received power, no signal-to-noise ratio.
  std::optional<double> transmit_power_dbm, bandwidth_hz;
  double noise_figure_db = 0;
};

// The patterns that an antenna may be instead of a file, and its ports.
using NamedAntenna = Choice<"isotropic", "short-dipole", "dipole", "tr38901">;
using Polarization = Choice<"V", "H", "VH", "cross">;

struct RadioEnd {  // [[transmitter]] or [[receiver]]
  std::string name;
  std::array<double, 3> position_m{0, 0, 0};  // file coordinates
  std::string antenna = "isotropic";          // a NamedAntenna, or a pattern file
  Polarization polarization = "V";
  std::array<double, 3> orientation_deg{0, 0, 0};  // yaw, pitch, roll (intrinsic z, y, x)
  std::array<double, 3> velocity_m_s{0, 0, 0};     // file axes; shifts frequencies, moves nothing
};

using HeightAbove = Choice<"zero", "ground">;

struct ReceiverGridConfig {  // [[receiver_grid]]: receivers NAME/IX,IY at the middles of square cells, for coverage
  std::string name;
  std::optional<double> x_min_m, x_max_m, y_min_m, y_max_m;  // file coordinates; not given: those of the scene
  double step_m = 5;                                         // side of a cell
  double height_m = 1.5;
  HeightAbove above = "zero";  // zero: height_m is z; ground: above the lowest surface there
  std::string antenna = "isotropic";
  Polarization polarization = "V";
  std::array<double, 3> orientation_deg{0, 0, 0};
};

// [trajectories]: how vehicles move. Give either file or generate, or [[track]] tables, or nothing: no vehicles.
struct TrajectoriesConfig {
  std::string file;                         // SUMO FCD or CSV, plain or gzip
  std::string generate;                     // arguments of `wavetracer scene city` about vehicles, instead of a file
  std::array<double, 3> offset_m{0, 0, 0};  // file coordinates of the scene = scale * those of `file` + this
  double scale = 1;                         // of positions in `file`
  bool persons = false, containers = false;
  std::string default_type;  // vehicle type of vehicles whose type is unknown; empty: such a vehicle is an error
};

struct TrackConfig {  // [[track]]: a vehicle on waypoints
  std::string id;
  std::string type = "passenger";
  std::vector<std::array<double, 4>> waypoints;  // time_s, x, y, z; file coordinates of the scene
};

// The bodies that a vehicle may have instead of a mesh file.
using NamedBody = Choice<"auto", "car", "van", "truck", "none">;

struct VehicleTypeConfig {  // [[vehicle_type]]: what a type of the trajectories looks like
  std::string name;
  std::string model = "auto";  // a NamedBody, or a mesh file (x ahead, z up, origin on the ground)
  // Not given: that of the mesh file, else of SUMO's class of this name.
  std::optional<double> length_m = {}, width_m = {}, height_m = {};
  std::string material = "metal";  // of a mesh without one
};

using MountRole = Choice<"transmitter", "receiver", "both">;

struct MountConfig {     // [[mount]]: an antenna on vehicles
  std::string name;      // the end is called VEHICLE/NAME
  std::string on = "*";  // ids or types of vehicles, * and ? as in shells
  MountRole role = "both";
  std::array<double, 3> offset_m{0, 0, 0};  // from the centre of the footprint: ahead, left, up
  std::string antenna = "isotropic";
  Polarization polarization = "V";
  std::array<double, 3> orientation_deg{0, 0, 0};  // in the vehicle's axes
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
using Reception = Choice<"exact", "sphere">;

struct TraceConfig {
  std::optional<uint64_t> rays = 200000;  // a transmitter; not set ("auto"): as many as recall asks for, up to max_rays
  double recall = 0.99;                   // of rays = "auto": wanted share of the paths
  uint64_t max_rays = 10000000;           // of rays = "auto"
  bool reuse = true;                      // sequences of earlier frames of a drive are kept and solved again
  std::optional<uint64_t> refresh_rays = {};  // a transmitter, of a frame that reuses; not given: a tenth of rays
  uint32_t forget_frames = 50;                // a sequence that no ray has met for so many frames is dropped
  uint32_t max_depth = 5;
  bool reflection = true, diffraction = false, transmission = false, scattering = false;
  uint32_t max_diffractions = 1;                  // a path, 1 or 2
  bool free_edges = true;                         // edges of one face diffract as half planes
  std::optional<uint64_t> diffraction_rays = {};  // of a receiver; not given: a tenth of rays, at least 100,000
  uint32_t max_transmissions = 2;                 // a path
  double tile_m = 5;                              // of scattering: no tile is longer
  Directions directions = "horizon";
  Reception reception = "exact";
  double sphere_radius_m = 1.0;
  uint64_t seed = 1;
  std::optional<uint64_t> batch_rays = {};  // in flight at once; not given: chosen from the device
};

// Those of the thesis have two words each, the plain name and the mnemonic; a configuration is echoed as it was given.
using OrderMethod = Choice<"none", "WS", "morton", "Z", "hilbert3d-histogram", "H3DH", "morton-histogram", "HZ",
                           "hilbert3d-histogram-hilbert2d", "H3DH2DH", "hilbert3d-histogram-hilbert3d", "H3DH3DH",
                           "direction-origin", "auto">;

struct OrderConfig {
  OrderMethod method = "none";
  bool each_depth = false;
  uint32_t bin_num = 16;  // bins a direction component, histogram methods
};

using LaunchDimensions = Choice<"auto", "1d", "2d", "3d">;

struct LaunchConfig {
  LaunchDimensions shape = "auto";
  std::optional<uint32_t> local_size = {};  // work-items of a group; not given: chosen from the device
};

using CacheKind = Choice<"none", "chained", "open", "concurrent">;
using CacheKey = Choice<"quantised", "exact">;
using CacheLocking = Choice<"mutex", "readers">;
using CachePurging = Choice<"position", "precision">;
using CacheScope = Choice<"static", "all">;
using CacheHitPoint = Choice<"own", "cached">;

struct CacheConfig {
  CacheKind kind = "none";
  CacheKey key = "quantised";        // quantised: primitive and cells of directions; exact: the ray itself
  uint32_t hash_method = 3;          // 1 uniform, 2 Morton, 3 mixed
  uint32_t division = 200000;        // cells a direction component, of a quantised key
  uint64_t buffer_size = 1048576;    // entries, shared evenly by the transmitters
  double load_factor = 3;            // chained: entries a bucket, on average
  CacheLocking locking = "readers";  // of an open table
  uint32_t readers_number = 5;       // open, readers: reads of an entry after which it is written anew
  CachePurging purge = "position";
  double position_step_m = 0.1;     // of the transmitter's position key
  double residual_value = 0.0125;   // precision: largest L1 distance of origins and directions
  CacheScope scope = "static";      // static: what vehicles and receivers decide is tested every time; all: it is kept
  CacheHitPoint hit_point = "own";  // of an answered ray: own (its line on the surface), cached (the other ray's)
  uint32_t first_depth = 1;         // segments before this one of a ray, counted from 1, are always traced
  bool statistics = false;          // hits an entry, and entries linked along paths
};

struct OutputConfig {
  std::string directory = "out";
  uint32_t shard_frames = 100;  // frames a file of a drive; the first of each is cold where frames reuse sequences
  uint64_t waypoints = 0;       // samples a transmitter whose waypoints are written, spread evenly; 0: none
  // Paths that are not written to paths.h5, see output/path_limits.hpp; not given: all are.
  std::optional<double> min_gain_db, dynamic_range_db;
  std::optional<uint32_t> max_paths_per_link = {};
  bool keep_shards = true;  // of a drive that is whole and merged
};

struct LiveVehicleConfig {  // [[live_vehicle]]: places for vehicles of one type, filled at run time by `wavetracer
                            // serve`
  std::string type = "passenger";
  uint32_t count = 1;
};

struct LiveConfig {                      // [live]: what `wavetracer serve` accepts
  double margin_m = 100;                 // vehicles may be as far outside of the scene's box
  uint32_t max_clients = 8;              // that have said hello
  uint32_t max_strangers = 8;            // that have not
  uint64_t max_message_bytes = 1048576;  // a line
  uint64_t max_queue_bytes = 67108864;   // unread answers of a client
  uint32_t max_pending_frames = 4;       // a client, not yet answered
  double max_rate_hz = 1000;             // messages of a client
  double hello_timeout_s = 3;            // from connecting to the end of hello
  double message_timeout_s = 5;          // from the first byte of a line to its end
  std::optional<double> idle_timeout_s = 300;
  double send_timeout_s = 10;  // answers unread
};

struct Config {
  std::string file;  // the TOML file, empty when built in code
  std::string text;  // all of it with --set applied, echoed into the outputs: echoed_config()
  SceneConfig scene;
  RadioConfig radio;
  std::vector<MaterialConfig> materials;
  std::vector<RadioEnd> transmitters, receivers;
  std::vector<ReceiverGridConfig> receiver_grids;
  TrajectoriesConfig trajectories;
  std::vector<TrackConfig> tracks;
  std::vector<VehicleTypeConfig> vehicle_types;
  std::vector<MountConfig> mounts;
  LinksConfig links;
  TimeConfig time;
  std::vector<LiveVehicleConfig> live_vehicles;
  LiveConfig live;
  TraceConfig trace;
  OrderConfig order;
  LaunchConfig launch;
  CacheConfig cache;
  OutputConfig output;
};

}  // namespace wavetracer
