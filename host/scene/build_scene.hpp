// From raw meshes to a Scene: recentred, welded, cleaned, with surfaces and edges.
// Assumes coordinates in metres, z up (units and axes are applied before), and one resolved material per mesh.
#pragma once
#include "scene/materials.hpp"
#include "scene/raw_scene.hpp"
#include "scene/scene_wedges.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// A triangle lower than this over its longest side is dropped as degenerate: its plane cannot be told from rounding
// (float32 coordinates, in which rays are traced, have steps of 1 um from 8 m off the origin on).
constexpr double degenerate_height_m = 1e-6;

// tolerance_m: vertices within it of a common plane are one surface, and are moved onto it (host/scene/flatten.hpp); of
// a mesh whose coordinates were rounded by more than half of it, twice its rounding. Zero: nothing is moved at all.
// edges: what to fill Scene::wedges with, which only diffraction needs. Throws InputError for an empty scene, or one of
// impossible size.
Scene build_scene(const RawScene& raw, ResolvedMaterials resolved, EdgeSearch edges = EdgeSearch::of_model,
                  double tolerance_m = 0);

}  // namespace wavetracer
