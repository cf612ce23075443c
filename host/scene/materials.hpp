// SPDX-License-Identifier: Apache-2.0
// Radio materials: what a material name of a scene file means under a configuration.
// Frequency matters only where one name has several laws: the one whose range contains it is taken.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "scene/material_laws.hpp"
#include "scene/raw_scene.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

struct ResolvedMaterials {
  std::vector<Material> materials;             // distinct, in order of first use
  std::vector<uint32_t> mesh_material;         // RawScene::meshes -> materials
  std::vector<uint32_t> volume_material = {};  // RawScene::volumes -> materials
  std::vector<std::string> warnings;
};

// Tells whether a warning says that no mesh uses a material.
bool says_unused(std::string_view warning);
// Removes from a scene's warnings those about unused materials, if one of the models uses the material.
void drop_used(std::vector<std::string>& warnings, const std::vector<Scene>& models);

// A name is looked up in this order: its alias (scene.material_alias); [[material]] or the file itself; the ITU
// material of that name. "mat-" and then "itu_" are stripped where the full name is not known. [[material]] of the
// configuration overrides file and table, field by field. If the edition has no law for the material at the frequency,
// the material keeps its range, and evaluating it fails later; with scene.extrapolate_materials the range is removed,
// with a warning. "vegetation" and "deciduous_vegetation" are leaves and twigs (VegetationLaw), unless [[material]]
// says otherwise. Throws InputError that names mesh, file and material.
ResolvedMaterials resolve_materials(const RawScene& raw, const SceneConfig& scene,
                                    const std::vector<MaterialConfig>& overrides, double frequency_hz);

}  // namespace wavetracer
