// SPDX-License-Identifier: Apache-2.0
// Builds a Scene from raw meshes: recentred, welded and cleaned, with surfaces and edges.
// It assumes coordinates in metres with z up (units and axes are converted before), and one resolved material per mesh.
#pragma once
#include "scene/materials.hpp"
#include "scene/raw_scene.hpp"
#include "scene/scene_wedges.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// A triangle whose height over its longest side is less than this is dropped as degenerate: rounding would decide its
// plane (float32 coordinates, in which rays are traced, have steps of 1 um from 8 m off the origin on).
constexpr double degenerate_height_m = 1e-6;

// tolerance_m: vertices within this distance of a common plane form one surface and are moved onto it
// (host/scene/flatten.hpp); for a mesh whose coordinates were rounded by more than half of it, twice the rounding is
// used. Zero: no vertex is moved. edges: the edges that Scene::wedges is filled with, which only diffraction needs.
// Throws InputError for an empty scene, or one of impossible size.
Scene build_scene(const RawScene& raw, ResolvedMaterials resolved, EdgeSearch edges = EdgeSearch::of_model,
                  double tolerance_m = 0);

}  // namespace wavetracer
