// The configuration of a run, one struct a table of the TOML file. Defaults live here, each with its reason
// in the field table (host/config/fields.cpp), which is what parsing, `validate`, `init` and `--help` are driven by.
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace wavetracer {

struct MaterialConfig {  // [[material]]: overrides or adds a radio material by name
  std::string name;
  std::optional<double> a, b, c, d;  // ITU-R P.2040 coefficients
  std::optional<double> permittivity, conductivity_s_m;
  std::optional<double> thickness_m;  // infinity allowed: a half space
};

struct SceneConfig {
  std::string file;                                   // absolute after parsing (given relative to the config file)
  std::string generate;                               // arguments of `wavetracer scene city`, instead of a file
  double scale = 1;                                   // metres a file unit (OBJ, GLB, PLY)
  std::string up = "auto";                            // "auto" (z, but y for glTF), "y" or "z"
  std::map<std::string, std::string> material_alias;  // [scene.material_alias]: name in the file -> radio material
  std::string default_material;                       // for meshes without one; empty: a missing material is an error
};

struct RadioConfig {
  double frequency_hz = 5.9e9;
};

struct RadioEnd {  // [[transmitter]] or [[receiver]]
  std::string name;
  std::array<double, 3> position_m{0, 0, 0};       // file coordinates
  std::string antenna = "isotropic";               // isotropic, short-dipole, dipole, tr38901, or a pattern file
  std::string polarization = "V";                  // V, H, VH, cross
  std::array<double, 3> orientation_deg{0, 0, 0};  // yaw, pitch, roll (intrinsic z, y, x)
  std::array<double, 3> velocity_m_s{0, 0, 0};     // file axes; shifts frequencies, moves nothing
};

struct TraceConfig {
  uint64_t rays = 1000000;  // a transmitter
  uint32_t max_depth = 5;
  bool reflection = true, diffraction = false, transmission = false, scattering = false;
  std::string directions = "hilbert";  // hilbert, fibonacci, random
  std::string reception = "exact";
  double sphere_radius_m = 1.0;
  uint64_t seed = 1;
  uint64_t batch_rays = 0;  // rays in flight at once; 0: chosen from the device
};

struct OrderConfig {
  std::string method = "none";
  bool each_depth = false;
  uint32_t bin_num = 16;  // bins a direction component, histogram methods
};

struct LaunchConfig {
  std::string shape = "auto";  // auto, 1d, 2d, 3d
  uint32_t local_size = 0;     // work-items a group; 0: chosen from the device
};

struct CacheConfig {
  std::string kind = "none";
  uint32_t hash_method = 3;
  uint32_t division = 200000;
  uint64_t buffer_size = 1048576;
  double load_factor = 0.75;
  uint32_t readers_number = 4;
  std::string purge = "position";
  double residual_value = 0.01;
};

struct OutputConfig {
  std::string directory = "out";
};

struct Config {
  std::string file;  // the TOML file, empty when built in code
  std::string text;  // its whole text with --set applied, echoed into the outputs
  SceneConfig scene;
  RadioConfig radio;
  std::vector<MaterialConfig> materials;
  std::vector<RadioEnd> transmitters, receivers;
  std::string trajectories_file;
  TraceConfig trace;
  OrderConfig order;
  LaunchConfig launch;
  CacheConfig cache;
  OutputConfig output;
};

}  // namespace wavetracer
