// SPDX-License-Identifier: Apache-2.0
// Names of https://github.com/KhronosGroup/glTF/tree/main/extensions, as of 2025.
#include "scene/gltf_extensions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// Extensions that GltfMeshes and GltfReader read; KHR_binary_glTF is the container of version 1.
constexpr std::array<std::string_view, 5> read_ones = {"EXT_mesh_gpu_instancing", "KHR_mesh_quantization",
                                                       "KHR_draco_mesh_compression", "KHR_node_visibility",
                                                       "KHR_binary_glTF"};

// Extensions about light, textures, sound, metadata and user interaction, which change no geometry. The entries are
// beginnings of names.
constexpr std::array<std::string_view, 37> harmless = {"KHR_materials_",
                                                       "KHR_texture_",
                                                       "KHR_lights_",
                                                       "KHR_xmp",
                                                       "KHR_animation_pointer",
                                                       "KHR_audio_",
                                                       "KHR_node_selectability",
                                                       "KHR_node_hoverability",
                                                       "KHR_interactivity",
                                                       "KHR_techniques_webgl",
                                                       "KHR_implicit_shapes",
                                                       "KHR_physics_rigid_bodies",
                                                       "KHR_accessor_float64_metadata",
                                                       "EXT_texture_",
                                                       "EXT_lights_",
                                                       "EXT_mesh_features",
                                                       "EXT_instance_features",
                                                       "EXT_structural_metadata",
                                                       "EXT_feature_metadata",
                                                       "EXT_mesh_manifold",
                                                       "EXT_property_",
                                                       "MSFT_texture_dds",
                                                       "MSFT_lod",
                                                       "MSFT_packing_",
                                                       "MSFT_audio_",
                                                       "MSFT_collision_mesh",
                                                       "MSFT_physics",
                                                       "ADOBE_materials_",
                                                       "AGI_articulations",
                                                       "AGI_stk_metadata",
                                                       "CESIUM_primitive_outline",
                                                       "FB_geometry_metadata",
                                                       "FB_ngon_encoding",
                                                       "GRIFFEL_bim_data",
                                                       "NV_materials_mdl",
                                                       "WEB3D_",
                                                       "VRM"};

bool is_known(std::string_view name) {
  return std::ranges::find(read_ones, name) != read_ones.end() ||
         std::ranges::any_of(harmless, [&](std::string_view beginning) { return name.starts_with(beginning); });
}

// Returns advice about an extension that is required and not read.
std::string advice_for(std::string_view name) {
  if (name.find("meshopt") != std::string_view::npos) return "export it without compression";
  if (name == "CESIUM_RTC") return "convert it with its centre applied to the nodes";
  if (name == "KHR_gaussian_splatting") return "a cloud of splats has no surfaces: export a mesh";
  return "export it without that extension, or as OBJ or PLY";
}

std::vector<std::string> names_of(const GltfFile& file, const char* list) {
  std::vector<std::string> out;
  if (!file.document.contains(list)) return out;
  for (const auto& name : file.document[list])
    if (name.is_string()) out.push_back(name.get<std::string>());
  return out;
}

}  // namespace

std::vector<std::string> check_gltf_extensions(const GltfFile& file) {
  const std::vector<std::string> required = names_of(file, "extensionsRequired");
  for (const std::string& name : required)
    if (!is_known(name))
      throw InputError(fmt::format("{}: it requires the extension {}, which is not read: {}", file.path.string(), name,
                                   advice_for(name)));
  std::vector<std::string> out;
  for (const std::string& name : names_of(file, "extensionsUsed"))
    // If meshopt is not required, the file also holds the uncompressed data.
    if (!is_known(name) && name.find("meshopt") == std::string::npos)
      out.push_back(
          fmt::format("{}: it uses the extension {}, which is not known and was left out", file.path.string(), name));
  return out;
}

}  // namespace wavetracer
