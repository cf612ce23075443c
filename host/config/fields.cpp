// The rows of the field table, one a key of the config file, in the order in which `init` writes them.
// The reason for each default stands in the doc of its row; the default itself is the initialiser in config.hpp.
#include "config/fields.hpp"
#include <utility>

namespace wavetracer::config {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Accessors: a member, a member of a sub-struct of Config, a member of an element of a vector of Config.
template <class M>
auto at(M Config::*member) {
  return [member](Config& c, size_t) -> Slot { return &(c.*member); };
}
template <class S, class M>
auto at(S Config::*part, M S::*member) {
  return [part, member](Config& c, size_t) -> Slot { return &(c.*part.*member); };
}
template <class E, class M>
auto at(std::vector<E> Config::*list, M E::*member) {
  return [list, member](Config& c, size_t i) -> Slot { return &((c.*list)[i].*member); };
}
template <auto List>
size_t append(Config& c) {
  (c.*List).emplace_back();
  return (c.*List).size() - 1;
}
template <auto List>
size_t count(const Config& c) {
  return (c.*List).size();
}

Table scene_table() {
  const auto s = [](auto member) { return at(&Config::scene, member); };
  return {.name = "scene",
          .doc = "The static world. Give either file or generate.",
          .fields = {
              {.name = "file",
               .slot = s(&SceneConfig::file),
               .form = Form::input_file,
               .doc = "Mitsuba XML with PLY or OBJ meshes, or one OBJ, GLB, glTF or PLY file."},
              {.name = "generate",
               .slot = s(&SceneConfig::generate),
               .doc = "A city made on the spot instead of a file: the arguments of `wavetracer scene city`.",
               .example = "\"--seed 1 --blocks 4\""},
              {.name = "scale",
               .slot = s(&SceneConfig::scale),
               .unit = "m a file unit",
               .range = {0, 1e6, true},
               .doc = "For OBJ, GLB and PLY. OBJ and PLY state no unit; 1 reads them as metres, as glTF is."},
              {.name = "up",
               .slot = s(&SceneConfig::up),
               .choices = {"auto", "y", "z"},
               .doc = "The axis of the file that points to the sky; auto is z, but y for glTF as its standard says."},
              {.name = "default_material",
               .slot = s(&SceneConfig::default_material),
               .doc = "Radio material of meshes that name none. Left empty, such a mesh is an error, because a guess "
                      "would be wrong in silence."},
              {.name = "material_alias",
               .slot = s(&SceneConfig::material_alias),
               .doc = "Material name in the scene file = radio material, for names that are not ITU-R P.2040 ones.",
               .example = "{ \"my wall\" = \"concrete\" }"},
          }};
}

Table material_table() {
  const auto m = [](auto member) { return at(&Config::materials, member); };
  return {.name = "material",
          .doc =
              "A radio material: overrides one of ITU-R P.2040 or adds one. Either a, b, c, d or permittivity and "
              "conductivity_s_m.",
          .fields =
              {
                  {.name = "name",
                   .slot = m(&MaterialConfig::name),
                   .required = true,
                   .doc = "The name that the scene uses, or that scene.material_alias maps to.",
                   .example = "\"concrete\""},
                  {.name = "a",
                   .slot = m(&MaterialConfig::a),
                   .range = {0, 1e6, true},
                   .doc = "Relative permittivity a f^b, f in GHz (ITU-R P.2040-3, Table 3).",
                   .example = "5.24"},
                  {.name = "b",
                   .slot = m(&MaterialConfig::b),
                   .range = {-10, 10},
                   .doc = "Exponent of the permittivity.",
                   .example = "0.0"},
                  {.name = "c",
                   .slot = m(&MaterialConfig::c),
                   .unit = "S/m",
                   .range = {0, 1e12},
                   .doc = "Conductivity c f^d, f in GHz (ITU-R P.2040-3, Table 3).",
                   .example = "0.0462"},
                  {.name = "d",
                   .slot = m(&MaterialConfig::d),
                   .range = {-10, 10},
                   .doc = "Exponent of the conductivity.",
                   .example = "0.7822"},
                  {.name = "permittivity",
                   .slot = m(&MaterialConfig::permittivity),
                   .range = {1, 1e6},
                   .doc = "Relative permittivity at every frequency, instead of a and b.",
                   .example = "5.24"},
                  {.name = "conductivity_s_m",
                   .slot = m(&MaterialConfig::conductivity_s_m),
                   .unit = "S/m",
                   .range = {0, 1e12},
                   .doc = "Conductivity at every frequency, instead of c and d.",
                   .example = "0.185"},
                  {.name = "thickness_m",
                   .slot = m(&MaterialConfig::thickness_m),
                   .unit = "m",
                   .range = {0, infinity, true},
                   .doc = "Of the slab; inf is a half space. Not given: that of the scene file, else 0.1 m.",
                   .example = "0.3"},
              },
          .append = append<&Config::materials>,
          .count = count<&Config::materials>,
          .optional = true};
}

template <auto List>
Table ends_table(std::string name, std::string doc, std::string example_name, std::string example_position) {
  const auto e = [](auto member) { return at(List, member); };
  return {
      .name = std::move(name),
      .doc = std::move(doc),
      .fields =
          {
              {.name = "name",
               .slot = e(&RadioEnd::name),
               .required = true,
               .doc = "Unique among all transmitters and receivers.",
               .example = std::move(example_name)},
              {.name = "position_m",
               .slot = e(&RadioEnd::position_m),
               .unit = "m",
               .required = true,
               .doc = "x, y, z in the coordinates of the scene file.",
               .example = std::move(example_position)},
              {.name = "antenna",
               .slot = e(&RadioEnd::antenna),
               .choices = {"isotropic", "short-dipole", "dipole", "tr38901"},
               .form = Form::choice_or_file,
               .doc = "Named, or a pattern file (CSV: theta_deg,phi_deg,v_re,v_im,h_re,h_im). isotropic leaves gains "
                      "that are those of the channel alone."},
              {.name = "polarization",
               .slot = e(&RadioEnd::polarization),
               .choices = {"V", "H", "VH", "cross"},
               .doc = "VH (V and H) and cross (+45 and -45 degrees) have two ports. V, as vehicle antennas are."},
              {.name = "orientation_deg",
               .slot = e(&RadioEnd::orientation_deg),
               .unit = "degrees",
               .doc = "Yaw, pitch, roll: intrinsic rotations about z, y, x."},
              {.name = "velocity_m_s",
               .slot = e(&RadioEnd::velocity_m_s),
               .unit = "m/s",
               .doc = "Along x, y, z. Gives the Doppler shift of each path; the end stays where it is."},
          },
      .append = append<List>,
      .count = count<List>};
}

Table trace_table() {
  const auto t = [](auto member) { return at(&Config::trace, member); };
  const std::string specular = "leave it false; this version finds line of sight and specular reflections";
  return {
      .name = "trace",
      .doc = "How rays discover the surfaces that paths may touch.",
      .fields = {
          {.name = "rays",
           .slot = t(&TraceConfig::rays),
           .unit = "rays a transmitter",
           .range = {1, 2147483648.0},
           .doc = "More rays find more of the weak paths; those found are exact in any case. A million finds more "
                  "than 99% of the paths of a city quarter at depth 5."},
          {.name = "max_depth",
           .slot = t(&TraceConfig::max_depth),
           .unit = "interactions",
           .range = {0, 32},
           .doc = "0 is line of sight alone. Beyond 5 a path in a street canyon carries little power."},
          {.name = "reflection", .slot = t(&TraceConfig::reflection), .doc = "Specular reflection."},
          {.name = "diffraction",
           .slot = t(&TraceConfig::diffraction),
           .doc = "Diffraction at edges.",
           .later = specular},
          {.name = "transmission",
           .slot = t(&TraceConfig::transmission),
           .doc = "Transmission through walls.",
           .later = specular},
          {.name = "scattering", .slot = t(&TraceConfig::scattering), .doc = "Diffuse scattering.", .later = specular},
          {.name = "directions",
           .slot = t(&TraceConfig::directions),
           .choices = {"hilbert", "fibonacci", "random"},
           .doc = "Launch directions. hilbert: equal-area cells along a Hilbert curve, so that neighbours in "
                  "memory are neighbours in space."},
          {.name = "seed",
           .slot = t(&TraceConfig::seed),
           .range = {0, 9223372036854775807.0},
           .doc = "Of directions = \"random\"."},
          {.name = "reception",
           .slot = t(&TraceConfig::reception),
           .choices = {"exact", "sphere"},
           .doc = "exact: the path is solved by the image method. sphere: a ray that passes near a receiver counts.",
           .later = "use \"exact\", which needs no reception sphere"},
          {.name = "sphere_radius_m",
           .slot = t(&TraceConfig::sphere_radius_m),
           .unit = "m",
           .range = {0, 1e4, true},
           .doc = "Of reception = \"sphere\".",
           .later = "leave it out: reception = \"exact\" needs no reception sphere"},
          {.name = "batch_rays",
           .slot = t(&TraceConfig::batch_rays),
           .unit = "rays",
           .range = {0, 2147483648.0},
           .doc = "Rays in flight at once, which bounds the device memory; results do not depend on it. 0: chosen "
                  "from the device."},
      }};
}

Table order_table() {
  const auto o = [](auto member) { return at(&Config::order, member); };
  return {
      .name = "order",
      .doc = "Sorting of the rays before they are traced. Paths do not depend on it, time does.",
      .fields = {
          {.name = "method",
           .slot = o(&OrderConfig::method),
           .choices = {"none", "WS", "morton", "Z", "hilbert3d-histogram", "H3DH", "morton-histogram", "HZ",
                       "hilbert3d-histogram-hilbert2d", "H3DH2DH", "hilbert3d-histogram-hilbert3d", "H3DH3DH",
                       "direction-origin", "auto"},
           .doc = "The plain name or the mnemonic of the method. none: with trace.directions = \"hilbert\" rays are "
                  "born in order and need no sort. direction-origin: by direction first, then by where the ray starts, "
                  "for each_depth. auto: the fastest, by a short measurement that is kept for the next run."},
          {.name = "each_depth",
           .slot = o(&OrderConfig::each_depth),
           .doc = "Sort before every depth, not only the first. With method = \"auto\" it is chosen too."},
          {.name = "bin_num",
           .slot = o(&OrderConfig::bin_num),
           .unit = "bins a direction component",
           .range = {1, 1024},
           .doc = "Of the histogram methods. 16, as in the thesis, sorts 12 bits; more bins, finer order, more passes "
                  "of the sort."},
      }};
}

Table launch_table() {
  const auto l = [](auto member) { return at(&Config::launch, member); };
  return {
      .name = "launch",
      .doc = "The shape in which the rays of a depth are handed to the device. Paths do not depend on it, time does.",
      .fields = {
          {.name = "shape",
           .slot = l(&LaunchConfig::shape),
           .choices = {"auto", "1d", "2d", "3d"},
           .doc = "auto: 1d, but 2d and 3d for the two methods that map the sorted rays along a curve of that "
                  "dimension, and those accept nothing else."},
          {.name = "local_size",
           .slot = l(&LaunchConfig::local_size),
           .unit = "work-items a group",
           .range = {0, 1024},
           .doc = "A power of two, spread evenly over the dimensions. 0: what suits the device."},
      }};
}

Table cache_table() {
  const auto c = [](auto member) { return at(&Config::cache, member); };
  return {.name = "cache",
          .doc = "Reuse of traced segments. Without effect while kind is none.",
          .fields = {
              {.name = "kind",
               .slot = c(&CacheConfig::kind),
               .choices = {"none", "chained", "open", "concurrent"},
               .doc = "The table that holds the segments.",
               .later = "use \"none\": every segment is then traced"},
              {.name = "hash_method",
               .slot = c(&CacheConfig::hash_method),
               .range = {1, 3},
               .doc = "1 uniform, 2 Morton, 3 mixed."},
              {.name = "division",
               .slot = c(&CacheConfig::division),
               .range = {1, 4294967295.0},
               .doc = "Cells a direction component; fewer give more hits and a larger error."},
              {.name = "buffer_size",
               .slot = c(&CacheConfig::buffer_size),
               .unit = "entries",
               .range = {1, 1e12},
               .doc = "Entries of the table."},
              {.name = "load_factor",
               .slot = c(&CacheConfig::load_factor),
               .range = {0, 1, true},
               .doc = "Largest share of the table in use."},
              {.name = "readers_number",
               .slot = c(&CacheConfig::readers_number),
               .range = {1, 65535},
               .doc = "Readers of one entry at once (kind = \"open\")."},
              {.name = "purge",
               .slot = c(&CacheConfig::purge),
               .choices = {"position", "precision"},
               .doc = "What makes an entry stale: the transmitter moved, or the residual grew too large."},
              {.name = "residual_value",
               .slot = c(&CacheConfig::residual_value),
               .unit = "scene units, L1",
               .range = {0, 1e6},
               .doc = "Largest residual of purge = \"precision\"."},
          }};
}

}  // namespace

const std::vector<Table>& tables() {
  static const std::vector<Table> all = {
      scene_table(),
      {.name = "radio",
       .doc = "The carrier.",
       .fields = {{.name = "frequency_hz",
                   .slot = at(&Config::radio, &RadioConfig::frequency_hz),
                   .unit = "Hz",
                   .range = {1e6, 1e12},
                   .doc = "5.9 GHz is the band of vehicle communication (ITS-G5, C-V2X). ITU-R P.2040 materials hold "
                          "from 1 to 100 GHz, most of them."}}},
      trace_table(),
      order_table(),
      launch_table(),
      cache_table(),
      {.name = "trajectories",
       .doc = "Moving vehicles.",
       .fields = {{.name = "file",
                   .slot = at(&Config::trajectories, &TrajectoriesConfig::file),
                   .form = Form::input_file,
                   .doc = "Positions over time.",
                   .later = "leave it out and give each end its position_m; a run is one frame"}}},
      {.name = "output",
       .doc = "What is written.",
       .fields = {{.name = "directory",
                   .slot = at(&Config::output, &OutputConfig::directory),
                   .form = Form::output_folder,
                   .doc = "Folder for paths.h5, links.csv and summary.json; `run -o` overrides it."}}},
      material_table(),
      ends_table<&Config::transmitters>("transmitter", "A radio end that launches rays; one table each, at least one.",
                                        "\"rsu\"", "[0.0, 0.0, 6.0]"),
      ends_table<&Config::receivers>("receiver", "A radio end that paths lead to; one table each, at least one.",
                                     "\"car\"", "[40.0, 0.0, 1.5]"),
  };
  return all;
}

Config prototype() {
  Config c;
  for (const Table& table : tables())
    if (table.append) table.append(c);
  return c;
}

}  // namespace wavetracer::config
