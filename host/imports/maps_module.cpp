// GDAL by dlopen, then the module beside the program, or where packages put it.
// GDAL's symbols are opened for all, since the module names no library of its own.
#include "imports/maps_module.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

namespace fs = std::filesystem;

constexpr const char* gdal_name = WAVETRACER_GDAL_NAME;  // "libgdal.so.32"; empty: built without

std::vector<fs::path> module_places() {
  constexpr const char* file = "wavetracer_maps.so";
  if (const char* const given = std::getenv("WAVETRACER_MAPS_MODULE"); given && *given) return {given};
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  return {here / file, (here / WAVETRACER_MAPS_FOLDER / file).lexically_normal()};
}

[[noreturn]] void fail(const std::string& needed_for, const std::string& why) {
  throw RuntimeError(fmt::format("{}: this kind of file is read by GDAL, and {}", needed_for, why));
}

template <class Function>
void look_up(void* module, const char* name, Function& function, const std::string& needed_for) {
  function = reinterpret_cast<Function>(dlsym(module, name));
  if (!function) fail(needed_for, fmt::format("wavetracer_maps.so has no function {}", name));
}

MapsModule open_module(const std::string& needed_for) {
  if (std::string_view(gdal_name).empty())
    fail(needed_for,
         "this wavetracer was built without it: install libgdal-dev and build it again, or convert the file to an "
         "OpenStreetMap or SUMO map");
  if (!dlopen(gdal_name, RTLD_NOW | RTLD_GLOBAL))
    fail(needed_for,
         fmt::format("{} cannot be opened ({}); Debian has it in the package libgdal{}", gdal_name, dlerror(),
                     std::string_view(gdal_name).substr(std::string_view(gdal_name).rfind('.') + 1)));
  void* module = nullptr;
  std::string tried;
  for (const fs::path& place : module_places()) {
    if (!module) module = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!module) tried += fmt::format("{}{}", tried.empty() ? "" : "; ", dlerror());
  }
  if (!module)
    fail(needed_for, fmt::format("the module for it, wavetracer_maps.so, cannot be opened: {}; wheels and bundles do "
                                 "not have it, the Debian package does",
                                 tried));
  MapsModule out{};
  decltype(&wt_maps_version) version = nullptr;
  look_up(module, "wt_maps_version", version, needed_for);
  if (version() != WT_MAPS_VERSION)
    fail(needed_for, "wavetracer_maps.so is of another version of wavetracer: install both from one package");
  look_up(module, "wt_maps_footprints", out.footprints, needed_for);
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
