// What fields need to know of a world and its radio ends as the tables that wavetracer/device/path_field.h reads: made
// once, and the same for every frame but for where the ends are.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "radio/path_columns.hpp"
#include "radio/vegetation_law.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/device/field_records.h"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct FieldTables {
  std::vector<device::wt_material> materials;  // those of all scenes, at the carrier's frequency
  std::vector<uint32_t> materials_of;          // of every surface of the world
  std::vector<uint32_t> surface_of_tile;       // with trace.scattering: of every tile and cell of the world (WT_CELL)
  std::vector<double> area_of_tile;            // m2; of a cell the side of a cube of its volume, m
  uint32_t cells = 0;                          // how many of the last tiles are cells of vegetation
  std::vector<device::wt_antenna> antennas;    // transmitters', then receivers', in the order of the configuration
  std::vector<double> samples;                 // of pattern files
  uint32_t transmitters = 0;                   // how many of the antennas are theirs
  Ports ports;
  double wavelength_m = 0;
  uint64_t seed = 0;
  uint32_t transmissions = 0;  // the most of a path; 0: waves do not pass surfaces
  uint32_t reflections = 0;    // likewise
  bool scatters = false;
  VolumeTable volumes;                       // of vegetation
  std::vector<device::wt_foliage> foliages;  // of its kinds
  device::wt_air air{};
  // Whether paths lose more than distance, surfaces and edges take.
  bool loses() const { return air.loss_np_m > 0 || air.rains || !foliages.empty(); }
};

// config: its transmitters and receivers are all of the world's. Throws ConfigError or InputError for an antenna that
// cannot be made, and ConfigError for a material that some surface uses and that is not known at radio.frequency_hz.
FieldTables make_field_tables(const Scene& scene, const Config& config, std::span<const Scene> models = {},
                              std::span<const Instance> instances = {});

// Ends in a frame. first_antenna: of the first end, in FieldTables::antennas.
std::vector<device::wt_field_end> field_ends(std::span<const EndState> ends, uint32_t first_antenna);

}  // namespace wavetracer
