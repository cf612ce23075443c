// SPDX-License-Identifier: Apache-2.0
// The module's file is found and read first, beside the program or where packages install it. Only then GDAL and the
// module are opened by dlopen, since libraries that GDAL loads stay until the process ends. GDAL's symbols are opened
// globally, since the module links no library itself.
#include "imports/maps_module.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <link.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <vector>

#include "base/environment.hpp"
#include "base/file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

namespace fs = std::filesystem;

// A name such as "libgdal.so.32"; empty if the program was built without GDAL.
constexpr const char* gdal_name = WAVETRACER_GDAL_NAME;

constexpr const char* other_formats =
    "or convert the file to OpenStreetMap, SUMO's polygons, CityJSON or CityGML, which are read without GDAL";

std::vector<std::string> module_places() {
  constexpr const char* file = "wavetracer_maps.so";
  if (const std::string given = environment("WAVETRACER_MAPS_MODULE"); !given.empty()) return {given};
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  return {(here / file).string(), (here / WAVETRACER_MAPS_FOLDER / file).lexically_normal().string()};
}

// A wheel brings its own libraries in a folder of this name. GDAL would load the system's copies of the same libraries
// into the process, which then crashes at its end.
bool is_from_wheel() {
  return dl_iterate_phdr(
             [](dl_phdr_info* object, size_t, void*) {
               return std::string_view(object->dlpi_name).find("/wavetracer.libs/") != std::string_view::npos ? 1 : 0;
             },
             nullptr) != 0;
}

[[noreturn]] void fail(const std::string& needed_for, const std::string& why) {
  throw RuntimeError(fmt::format("{}: this kind of file is read by GDAL, and {}", needed_for, why));
}

template <class Function>
void look_up(void* module, const char* name, Function& function, const std::string& needed_for) {
  function = reinterpret_cast<Function>(dlsym(module, name));
  if (!function) fail(needed_for, fmt::format("wavetracer_maps.so has no function {}", name));
}

// Returns the module's file of this version.
std::string find_module(const std::string& needed_for) {
  const std::vector<std::string> places = module_places();
  for (const std::string& place : places) {
    std::error_code error;
    if (!fs::is_regular_file(place, error)) continue;
    if (read_file(place).find(WT_MAPS_MARK) != std::string::npos) return place;
    fail(needed_for, fmt::format("the module for it, {}, is not that of this version of wavetracer: install "
                                 "or build both together",
                                 place));
  }
  fail(needed_for, fmt::format("the module for it, wavetracer_maps.so, is not there ({}): "
                               "install wavetracer's Debian package, or build it from its source with libgdal-dev "
                               "(`./dev run`), {}",
                               fmt::join(places, ", "), other_formats));
}

MapsModule open_module(const std::string& needed_for) {
  if (is_from_wheel())
    fail(needed_for,
         fmt::format(
             "wheels come without it: convert the file with wavetracer's Debian package or a build of its source, "
             "whose scene this one reads, {}",
             other_formats));
  if (std::string_view(gdal_name).empty())
    fail(needed_for, fmt::format("this wavetracer was built without it: install libgdal-dev and build it again, {}",
                                 other_formats));
  const std::string place = find_module(needed_for);
  if (!dlopen(gdal_name, RTLD_NOW | RTLD_GLOBAL))
    fail(needed_for,
         fmt::format("{} cannot be opened ({}); Debian has it in the package libgdal{}", gdal_name, dlerror(),
                     std::string_view(gdal_name).substr(std::string_view(gdal_name).rfind('.') + 1)));
  void* const module = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!module)
    fail(needed_for,
         fmt::format("the module for it, {}, cannot be opened: {}; install or build both together", place, dlerror()));
  MapsModule out{};
  decltype(&wt_maps_version) version = nullptr;
  look_up(module, "wt_maps_version", version, needed_for);
  if (version() != WT_MAPS_VERSION)
    fail(needed_for, "wavetracer_maps.so is of another version of wavetracer: install both from one package");
  look_up(module, "wt_maps_shapes", out.shapes, needed_for);
  look_up(module, "wt_maps_open_raster", out.open_raster, needed_for);
  look_up(module, "wt_maps_places_of_posts", out.places_of_posts, needed_for);
  look_up(module, "wt_maps_close_raster", out.close_raster, needed_for);
  return out;
}

}  // namespace

const MapsModule& maps_module(const std::string& needed_for) {
  static const MapsModule module = open_module(needed_for);
  return module;
}

}  // namespace wavetracer::imports
