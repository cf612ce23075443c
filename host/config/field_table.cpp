// SPDX-License-Identifier: Apache-2.0
// The rows of the field table, one per key of the config file, in the order in which `init` writes them.
// The doc of each row gives the reason for its default; the default itself is the initialiser in config.hpp.
#include "config/field_table.hpp"

#include "config/field_rows.hpp"

namespace wavetracer::config {
namespace {

Table order_table() {
  const auto o = [](auto member) { return at(&Config::order, member); };
  return {.name = "order",
          .doc = "Sorting of the rays before they are traced. The paths do not depend on it, only the time does.",
          .fields = {
              {.name = "method",
               .slot = o(&OrderConfig::method),
               .doc = "The method, by its plain name or its mnemonic. none: no sorting; "
                      "with trace.directions = \"horizon\" or \"hilbert\" rays are launched in a good order already. "
                      "direction-origin: by direction first, "
                      "then by origin; use it with each_depth. auto: the fastest method, "
                      "found by a short measurement that is kept for later runs."},
              {.name = "each_depth",
               .slot = o(&OrderConfig::each_depth),
               .doc = "Sort before every depth, not only before the first. "
                      "With method = \"auto\" this is chosen automatically too."},
              {.name = "bin_num",
               .slot = o(&OrderConfig::bin_num),
               .unit = "bins per direction component",
               .range = {1, 1024},
               .doc = "Only for the histogram methods. 16, as in the thesis, gives keys of 12 bits; "
                      "more bins give a finer order and need more passes of the sort."},
          }};
}

Table launch_table() {
  const auto l = [](auto member) { return at(&Config::launch, member); };
  return {.name = "launch",
          .doc =
              "The shape of the OpenCL kernel launches that process the rays of one depth. "
              "The paths do not depend on it, only the time does.",
          .fields = {
              {.name = "shape",
               .slot = l(&LaunchConfig::shape),
               .doc = "auto: 1d, except for the two methods that map the sorted rays along a curve in 2 "
                      "or 3 dimensions; they need 2d or 3d and accept no other shape."},
              {.name = "local_size",
               .slot = l(&LaunchConfig::local_size),
               .unit = "work-items per work-group",
               .range = {0, 1024},
               .none = "0",
               .doc = "A power of two, divided evenly among the dimensions. 0: chosen for the device."},
          }};
}

// Adds the words of each Choice, and the word of an optional that is not set, as choices.
std::vector<Table> with_words(std::vector<Table> tables) {
  Config sample;
  for (Table& table : tables) {
    if (table.append) table.append(sample);
    for (Field& field : table.fields) {
      const Slot slot = field.slot(sample, 0);
      if (const auto* choice = std::get_if<ChoiceSlot>(&slot))
        field.choices.assign(choice->words.begin(), choice->words.end());
      else if (!field.none.empty() && field.none != "0")
        field.choices = {field.none};
    }
  }
  return tables;
}

Table radio_table() {
  return {
      .name = "radio",
      .doc = "The carrier, and the link budget.",
      .fields = {{.name = "frequency_hz",
                  .slot = at(&Config::radio, &RadioConfig::frequency_hz),
                  .unit = "Hz",
                  .range = {1e6, 1e12},
                  .doc = "The carrier frequency. 5.9 GHz is the band of vehicle communication (ITS-G5, C-V2X). "
                         "Most materials of ITU-R P.2040 are valid from 1 to 100 GHz."},
                 frequencies_field(),
                 wavefront_field(),
                 {.name = "transmit_power_dbm",
                  .slot = at(&Config::radio, &RadioConfig::transmit_power_dbm),
                  .unit = "dBm",
                  .range = {-200, 200},
                  .doc = "The power of each transmitter, for received powers in links.csv, plots and maps. Not given: "
                         "only gains are written. 23 dBm is usual for ITS-G5 and C-V2X."},
                 {.name = "bandwidth_hz",
                  .slot = at(&Config::radio, &RadioConfig::bandwidth_hz),
                  .unit = "Hz",
                  .range = {1, 1e12},
                  .doc = "The bandwidth of the noise, k T B at 290 K, for signal-to-noise ratios beside received "
                         "powers; paths do not depend on it. 10 MHz is a channel of ITS-G5."},
                 {.name = "noise_figure_db",
                  .slot = at(&Config::radio, &RadioConfig::noise_figure_db),
                  .unit = "dB",
                  .range = {0, 100},
                  .doc = "The noise figure of each receiver: how far its noise is above k T B. "
                         "0 is a receiver without noise of its own; 3GPP assumes 9 dB for vehicles."}}};
}

}  // namespace

const std::vector<Table>& tables() {
  static const std::vector<Table> all = with_words({
      scene_table(),       trajectories_table(), time_table(),         links_table(),         radio_table(),
      air_table(),         trace_table(),        order_table(),        launch_table(),        cache_table(),
      live_table(),        response_table(),     output_table(),       material_table(),      vegetation_table(),
      transmitter_table(), receiver_table(),     station_table(),      receiver_grid_table(), array_table(),
      mount_table(),       vehicle_type_table(), target_model_table(), target_part_table(),   target_table(),
      radar_table(),       track_table(),        parked_table(),       live_vehicle_table(),
  });
  return all;
}

Config prototype() {
  Config c;
  for (const Table& table : tables())
    if (table.append) table.append(c);
  return c;
}

}  // namespace wavetracer::config
