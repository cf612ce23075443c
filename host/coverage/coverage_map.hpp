// SPDX-License-Identifier: Apache-2.0
// Maps of a receiver grid in one frame of a run: layers of one value a cell, for one transmitter or for the strongest.
// Rows go north, or up in a map of a vertical plane.
// A value is NaN where there is none. All transmitters send radio.transmit_power_dbm.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>
#include "results/link_rows.hpp"
#include "results/link_table.hpp"
#include "results/saved_run.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::coverage {

// The values of a cell. Its server is the transmitter that was named, or else the one with the largest path gain.
struct Cell {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double path_gain_db = none;
  double narrowband_gain_db = none;  // gain of the server at the carrier: fields of all paths with their phases
  double received_dbm = none;
  double snr_db = none;
  double sinr_db = none;
  double interference_dbm = none;  // sum of the received powers of all transmitters but the server
  double best_server = none;       // row of the transmitter with the largest path gain, whether or not one was named
  double margin_db = none;         // path gain of the server over the largest one of the others
  double delay_spread_ns = none;
  double k_factor_db = none;    // power of the direct path over that of all others; infinite if there is no other one
  double line_of_sight = none;  // 1 if the server has a direct path to the cell, else 0
  double paths = none;          // number of paths of the server
  double beam_gain_db = none;   // gain of the server through the best pair of beams
  double tx_beam = none, rx_beam = none;  // numbers of these beams
  // Gain of the server over the area of the cell, where its paths are plane waves: the mean of the coherent power, and
  // the amount of fading, its variance divided by the square of the mean (minus infinity: the same power everywhere).
  double cell_mean_db = none, fading_db = none;
};

// The values of a cell over samples of the inputs (chance_map.hpp).
struct Chances {
  double samples = 0;  // samples in which the cell has a path
  // Over these samples; without two of them there is no deviation.
  double path_gain_mean_db = Cell::none, path_gain_deviation_db = Cell::none;
  // Shares of all samples in which a value is at least its threshold; a sample without that value is below it.
  double path_gain = Cell::none, received = Cell::none, snr = Cell::none, sinr = Cell::none;
};

struct LayerKind {
  std::string_view name, unit, words;  // unit: empty for numbers without one
  double Cell::*value;                 // null: the layer is one of Chances
  // The layer needs radio.transmit_power_dbm, radio.bandwidth_hz, or an array with a codebook.
  bool of_powers = false, of_noise = false, of_beams = false;
  bool of_areas = false;              // the layer is made of the paths that paths.h5 has
  double Chances::*chance = nullptr;  // null: the layer is one of Cell
  double Cell::*tested = nullptr;     // the value that has a threshold; null: the layer is no share of samples
  // Tells whether values are choices, which have colours of their own, and not amounts.
  constexpr bool of_choices() const {
    return value == &Cell::line_of_sight || value == &Cell::best_server || of_pair();
  }
  // Tells whether values are numbers of beams.
  constexpr bool of_pair() const { return value == &Cell::tx_beam || value == &Cell::rx_beam; }
};

inline constexpr std::array<LayerKind, 17> layer_kinds = {{
    {"path_gain_db", "dB", "path gain", &Cell::path_gain_db},
    {"narrowband_gain_db", "dB", "narrowband gain", &Cell::narrowband_gain_db},
    {"received_dbm", "dBm", "received power", &Cell::received_dbm, true},
    {"snr_db", "dB", "signal-to-noise ratio", &Cell::snr_db, true, true},
    {"sinr_db", "dB", "signal to interference and noise", &Cell::sinr_db, true, true},
    {"interference_dbm", "dBm", "power of the other transmitters", &Cell::interference_dbm, true},
    {"best_server", "", "strongest transmitter", &Cell::best_server},
    {"margin_db", "dB", "path gain over the strongest other transmitter", &Cell::margin_db},
    {"delay_spread_ns", "ns", "rms delay spread", &Cell::delay_spread_ns},
    {"k_factor_db", "dB", "power of the direct path over that of all others", &Cell::k_factor_db},
    {"line_of_sight", "", "line of sight", &Cell::line_of_sight},
    {"paths", "", "number of paths", &Cell::paths},
    {"cell_mean_db", "dB", "mean narrowband gain over the cell", &Cell::cell_mean_db, false, false, false, true},
    {"fading_db", "dB", "amount of fading within the cell", &Cell::fading_db, false, false, false, true},
    {"beam_gain_db", "dB", "gain through the best pair of beams", &Cell::beam_gain_db, false, false, true},
    {"tx_beam", "", "beam of the transmitter", &Cell::tx_beam, false, false, true},
    {"rx_beam", "", "beam of the receiver", &Cell::rx_beam, false, false, true},
}};

// The layers of samples of the inputs. Those of thresholds are there if their threshold is.
inline constexpr std::array<LayerKind, 7> chance_kinds = {{
    {.name = "path_gain_mean_db",
     .unit = "dB",
     .words = "mean path gain over samples of the inputs",
     .value = nullptr,
     .chance = &Chances::path_gain_mean_db},
    {.name = "path_gain_deviation_db",
     .unit = "dB",
     .words = "standard deviation of the path gain over samples of the inputs",
     .value = nullptr,
     .chance = &Chances::path_gain_deviation_db},
    {.name = "samples",
     .unit = "",
     .words = "samples of the inputs with a path",
     .value = nullptr,
     .chance = &Chances::samples},
    {.name = "path_gain_probability",
     .unit = "",
     .words = "probability of the path gain to reach its threshold",
     .value = nullptr,
     .chance = &Chances::path_gain,
     .tested = &Cell::path_gain_db},
    {.name = "received_probability",
     .unit = "",
     .words = "probability of the received power to reach its threshold",
     .value = nullptr,
     .chance = &Chances::received,
     .tested = &Cell::received_dbm},
    {.name = "snr_probability",
     .unit = "",
     .words = "probability of the signal-to-noise ratio to reach its threshold",
     .value = nullptr,
     .chance = &Chances::snr,
     .tested = &Cell::snr_db},
    {.name = "sinr_probability",
     .unit = "",
     .words = "probability of the signal to interference and noise to reach its threshold",
     .value = nullptr,
     .chance = &Chances::sinr,
     .tested = &Cell::sinr_db},
}};

// Returns the names of all kinds of layer_kinds, in their order.
std::vector<std::string> layer_names();

// Returns the kind of that name. Throws ConfigError, with a hint, if there is none.
const LayerKind& layer_kind(const std::string& name);

// A value of a probability layer, in the unit of the tested layer.
struct Threshold {
  const LayerKind* layer = nullptr;   // the row of chance_kinds
  const LayerKind* tested = nullptr;  // the row of layer_kinds
  double least = 0;
};

// The plane of a map whose columns go from from_m to to_m, and whose rows go up.
struct VerticalPlane {
  glm::dvec2 from_m{0}, to_m{0}, direction{1, 0};  // direction: unit vector between them
  double first_along_m = 0, first_z_m = 0;         // middle of cell 0,0: its distance from from_m, and its height

  // Returns the distance of a place from from_m along the plane, and its distance from the plane.
  glm::dvec2 along_and_off_m(double x_m, double y_m) const {
    const double x = x_m - from_m.x, y = y_m - from_m.y;
    return {x * direction.x + y * direction.y, x * direction.y - y * direction.x};
  }
};

struct Map {
  std::string grid;
  uint32_t columns = 0, rows = 0;
  // Middle of cell 0,0 and the distance of cells, in file coordinates; on a vertical plane the distances along it and
  // in z.
  glm::dvec2 first_m{0}, step_m{0};
  std::vector<double> z_m = {};     // heights of cells, row by row from the south
  std::optional<uint32_t> tx = {};  // the transmitter that was named
  std::vector<std::string> transmitters = {};
  uint32_t frame = 0;
  double time_s = 0;
  std::vector<Cell> cells = {};               // row by row from the south
  bool areas = false;                         // layers of areas were computed
  bool beams = false;                         // a link to the grid has beams, in this frame or in one beside it
  std::vector<const LayerKind*> layers = {};  // those that the run can tell, in the order of layer_kinds or as asked
  std::vector<std::string> left_out = {};     // why layers are not there
  std::vector<std::string> notes = {};        // words about paths that layers do not include
  bool only_streets = false;                  // cells that are on no street were left without values
  std::optional<VerticalPlane> plane = {};    // nothing: the map is horizontal, or lies on the ground
  uint32_t samples = 0;                       // samples of the inputs; 0: the map is that of a run
  std::vector<Threshold> thresholds = {};     // with samples
  std::vector<Chances> chances = {};          // with samples, one for each cell; `cells` are then those without errors

  double x_m(size_t cell) const {
    return first_m.x + static_cast<double>(cell % columns) * step_m.x * (plane ? plane->direction.x : 1);
  }
  double y_m(size_t cell) const {
    if (plane) return first_m.y + static_cast<double>(cell % columns) * step_m.x * plane->direction.y;
    return first_m.y + static_cast<double>(cell / columns) * step_m.y;
  }
  // Returns the distance of a cell of a vertical plane from the plane's begin.
  double along_m(size_t cell) const { return plane->first_along_m + static_cast<double>(cell % columns) * step_m.x; }
  // Tells whether the cell has a path from its server.
  bool reached(size_t cell) const { return cells[cell].paths > 0; }
  size_t reached_cells() const;
  double value(const LayerKind& layer, size_t cell) const {
    return layer.chance ? chances[cell].*layer.chance : cells[cell].*layer.value;
  }
  std::vector<double> values(const LayerKind& layer) const;
};

// Throws ConfigError if the layer needs a key of [radio] that is not set, or beams that the map lacks. option: its
// name, for the error.
void check_layer(const LayerKind& layer, const RadioConfig& radio, const Map& map, const std::string& option);

struct MapChoice {
  std::optional<uint32_t> tx = {};       // nothing: the strongest transmitter of each cell
  std::vector<std::string> layers = {};  // names; none: all that the run can tell
  bool areas = true;                     // if no layer is named, those of areas are there, too; they take longest
};

// Makes the map of a frame. links: of this frame (results/link_rows.hpp). Throws InputError if the run lacks receivers
// of the grid, or has them twice, ConfigError for layers that there are not, or that were named and need what the run
// does not have.
Map coverage_map(const SavedRun& run, const RadioConfig& radio, const SavedFrame& frame,
                 const std::vector<LinkRow>& links, const ReceiverGridConfig& grid, const MapChoice& choice);

// Makes the maps of the rows first_row to last_row of a run, which all have the same layers: a layer that can be told
// in one of these frames is there in all. table: the run's links.csv. Throws as coverage_map does.
std::vector<Map> coverage_maps(const SavedRun& run, const RadioConfig& radio, size_t first_row, size_t last_row,
                               const LinkTable& table, const ReceiverGridConfig& grid, const MapChoice& choice);

}  // namespace wavetracer::coverage
