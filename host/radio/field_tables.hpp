// SPDX-License-Identifier: Apache-2.0
// The data of a world and its radio ends that fields need, as the tables that wavetracer/device/path_field.h reads:
// they are made once, and the same for every frame, except for the places of the ends.
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "radio/path_columns.hpp"
#include "radio/target_laws.hpp"
#include "radio/vegetation_law.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/device/field_records.h"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct FieldTables {
  std::vector<device::wt_material> materials;  // those of all scenes, at the carrier's frequency
  std::vector<uint32_t> materials_of;          // material of each surface of the world
  std::vector<std::string> names, walls;       // those of each record, see MaterialTable
  std::vector<uint32_t> surface_of_tile;  // with trace.scattering: surface of each tile and cell of the world (WT_CELL)
  std::vector<double> area_of_tile;       // m2; for a cell the side of a cube of its volume, m
  uint32_t cells = 0;                     // number of cells of vegetation, which are the last tiles
  std::vector<device::wt_antenna> antennas;  // transmitters', then receivers', in the order of the configuration
  std::vector<double> samples;               // samples of pattern files
  uint32_t transmitters = 0;                 // the number of transmitters' antennas
  Ports ports;
  double wavelength_m = 0;
  uint64_t seed = 0;
  uint32_t transmissions = 0;  // the most of a path; 0: waves do not pass surfaces
  uint32_t reflections = 0;    // the most of a path
  bool scatters = false;
  bool reflects_scattered = false;           // paths that scatter may be reflected before and after
  bool bends_scattered = false;              // paths that scatter may have an edge beside their tile
  bool edge_ends = false;                    // edges with free ends diffract
  bool corners = false;                      // edges with less than a half space around them diffract
  bool reflects_echoes = false;              // paths over targets may be reflected before and after
  TargetLaws targets;                        // laws of points of targets; empty without targets
  VolumeTable volumes;                       // volumes of vegetation
  std::vector<device::wt_foliage> foliages;  // kinds of vegetation
  device::wt_air air{};
  // Does a surface have several layers?
  bool layered() const {
    return std::ranges::any_of(materials, [](const device::wt_material& material) { return material.layers != 0; });
  }
  // Do air or vegetation take power from paths, besides distance, surfaces and edges?
  bool loses() const { return air.loss_np_m > 0 || air.rains || !foliages.empty(); }
};

// config: its transmitters and receivers are all those of the world. Throws ConfigError or InputError for an antenna
// that cannot be made, and ConfigError for a material that some surface uses and that is not known at
// radio.frequency_hz.
FieldTables make_field_tables(const Scene& scene, const Config& config, std::span<const Scene> models = {},
                              std::span<const Instance> instances = {});

// The ends in a frame. first_antenna: the number of the first end's antenna in FieldTables::antennas.
std::vector<device::wt_field_end> field_ends(std::span<const EndState> ends, uint32_t first_antenna);

}  // namespace wavetracer
