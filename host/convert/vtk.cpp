// SPDX-License-Identifier: Apache-2.0
// Writes for ParaView: a folder of .vtp files, and run.pvd, which gives them their times. Coordinates are those of the
// files, z up. One frame at a time is in memory. An object that does not move is one file, which every time of the .pvd
// names.
#include <fmt/format.h>
#include "base/pending_folder.hpp"
#include "convert/convert.hpp"
#include "convert/vtk_file.hpp"
#include "convert/vtk_glb_kml.hpp"
#include "convert/vtk_rays.hpp"
#include "output/path_kinds.hpp"
#include "results/saved_waypoints.hpp"
#include "results/saved_world.hpp"
#include "scene/volume_surface.hpp"

namespace wavetracer {
namespace {

void put(const PendingFolder& folder, const std::string& name, const VtkFile& file) {
  folder.append(name, file.head());
  folder.append(name, file.body());
  folder.append(name, VtkFile::tail());
}

std::vector<std::string> names_of(const auto& rows, auto name) {
  std::vector<std::string> out;
  for (const auto& row : rows) out.push_back(row.*name);
  return out;
}

void add_time(VtkFile& file, const SavedFrame& frame) {
  file.add(VtkFile::field_data, "TimeValue", std::vector{frame.time_s});
  file.add(VtkFile::field_data, "frame", std::vector{frame.number});
}

// Triangles, gathered from one scene or from many models.
struct Triangles {
  std::vector<glm::dvec3> points;
  std::vector<int64_t> corners, ends;
  std::vector<uint32_t> material, surface;

  // position(vertex): file coordinates. first_material: index of the scene's first material among the names of the
  // file.
  void append(const Scene& scene, uint32_t first_material, const auto& position) {
    const auto first = static_cast<int64_t>(points.size());
    for (const glm::dvec3& vertex : scene.vertices) points.push_back(position(vertex));
    for (size_t i = 0; i < scene.triangles.size(); ++i) {
      for (const uint32_t corner : scene.triangles[i]) corners.push_back(first + corner);
      ends.push_back(static_cast<int64_t>(corners.size()));
      surface.push_back(scene.triangle_surface[i]);
      material.push_back(first_material + scene.surfaces[scene.triangle_surface[i]].material);
    }
  }

  void add_to(VtkFile& file) const {
    file.add_points(points);
    file.add_cells(VtkFile::polys, corners, ends);
    file.add(VtkFile::cell_data, "material", material);
    file.add(VtkFile::cell_data, "surface", surface);
  }
};

VtkFile scene_file(const Scene& scene) {
  Triangles triangles;
  triangles.append(scene, 0, [&](const glm::dvec3& vertex) { return scene.origin_m + vertex; });
  VtkFile file;
  triangles.add_to(file);
  file.add(VtkFile::cell_data, "object", scene.triangle_object);
  file.add(VtkFile::field_data, "material_names", names_of(scene.materials, &Material::name));
  file.add(VtkFile::field_data, "object_names", scene.objects);
  return file;
}

VtkFile vegetation_file(const Scene& scene) {
  std::vector<glm::dvec3> points;
  std::vector<int64_t> corners, ends;
  std::vector<uint32_t> material, number;
  for (uint32_t i = 0; i < scene.volumes.size(); ++i)
    for (const auto& triangle : surface_triangles(scene.volumes[i])) {
      for (const glm::dvec3& corner : triangle) {
        corners.push_back(static_cast<int64_t>(points.size()));
        points.push_back(scene.origin_m + corner);
      }
      ends.push_back(static_cast<int64_t>(points.size()));
      material.push_back(scene.volumes[i].material);
      number.push_back(i);
    }
  VtkFile file;
  file.add_points(points);
  file.add_cells(VtkFile::polys, corners, ends);
  file.add(VtkFile::cell_data, "material", material);
  file.add(VtkFile::cell_data, "volume", number);
  file.add(VtkFile::field_data, "material_names", names_of(scene.materials, &Material::name));
  return file;
}

// Adds the wedges at which waves diffract; free edges only if trace.free_edges counts them. Returns false if there is
// none.
bool add_edges(VtkFile& file, const Scene& scene, bool free_edges) {
  std::vector<glm::dvec3> points;
  std::vector<int64_t> connectivity, ends;
  std::vector<uint32_t> index, surfaces;
  std::vector<double> exterior_rad;
  for (uint32_t i = 0; i < scene.wedges.size(); ++i) {
    const Wedge& wedge = scene.wedges[i];
    if (!free_edges && wedge.surface[0] == wedge.surface[1]) continue;
    for (const double along_m : {0.0, wedge.length_m}) {
      connectivity.push_back(static_cast<int64_t>(points.size()));
      points.push_back(scene.origin_m + wedge.start + along_m * wedge.along);
    }
    ends.push_back(static_cast<int64_t>(points.size()));
    index.push_back(i);
    exterior_rad.push_back(wedge.exterior_rad);
    surfaces.insert(surfaces.end(), wedge.surface.begin(), wedge.surface.end());
  }
  file.add_points(points);
  file.add_cells(VtkFile::lines, connectivity, ends);
  file.add(VtkFile::cell_data, "wedge", index);
  file.add(VtkFile::cell_data, "exterior_rad", exterior_rad);
  file.add(VtkFile::cell_data, "surfaces", surfaces, 2);
  return !index.empty();
}

VtkFile vehicles_file(const SavedRun& run, const SavedWorld& world, const SavedFrame& frame) {
  Triangles triangles;
  std::vector<uint32_t> first_material{0}, vehicle;
  std::vector<std::string> materials;
  for (const Scene& model : world.models) {
    for (const Material& material : model.materials) materials.push_back(material.name);
    first_material.push_back(static_cast<uint32_t>(materials.size()));
  }
  for (const SavedPose& pose : frame.poses) {
    const uint32_t m = world.instance_model[pose.instance];
    if (m == no_instance || !is_finite(pose)) continue;
    const Scene& model = world.models[m];
    triangles.append(model, first_material[m], [&](const glm::dvec3& vertex) { return placed(pose, model, vertex); });
    vehicle.resize(triangles.ends.size(), pose.instance);
  }
  VtkFile file;
  triangles.add_to(file);
  file.add(VtkFile::cell_data, "vehicle", vehicle);
  file.add(VtkFile::field_data, "material_names", materials);
  file.add(VtkFile::field_data, "vehicle_names", names_of(run.instances(), &SavedInstance::id));
  add_time(file, frame);
  return file;
}

VtkFile ends_file(const SavedRun& run, const SavedFrame& frame) {
  std::vector<glm::dvec3> points, velocity_m_s;
  std::vector<int64_t> connectivity, ends;
  std::vector<uint8_t> is_receiver;
  std::vector<uint32_t> index;
  std::vector<std::string> names;
  const auto append = [&](bool receiver, const auto& configured, const auto& positions, const auto& velocities) {
    for (uint32_t i = 0; i < configured.size(); ++i) {
      if (!is_finite(positions[i])) continue;  // it is absent
      connectivity.push_back(static_cast<int64_t>(points.size()));
      points.push_back(positions[i]);
      ends.push_back(static_cast<int64_t>(points.size()));
      velocity_m_s.push_back(velocities[i]);
      is_receiver.push_back(receiver);
      index.push_back(i);
      names.push_back(configured[i].name);
    }
  };
  append(false, run.transmitters(), frame.transmitter_position_m, frame.transmitter_velocity_m_s);
  append(true, run.receivers(), frame.receiver_position_m, frame.receiver_velocity_m_s);
  VtkFile file;
  file.add_points(points);
  file.add_cells(VtkFile::verts, connectivity, ends);
  file.add(VtkFile::point_data, "is_receiver", is_receiver);
  file.add(VtkFile::point_data, "index", index);
  file.add(VtkFile::point_data, "velocity_m_s", velocity_m_s);
  file.add(VtkFile::point_data, "name", names);
  add_time(file, frame);
  return file;
}

// Paths are polylines. The ends of a path have interaction 0; surface and vehicle are -1 where there is none.
VtkFile paths_file(const SavedRun& run, const SavedFrame& frame, size_t& left_out) {
  const Paths& paths = frame.paths;
  std::vector<glm::dvec3> points;
  std::vector<int64_t> connectivity, ends;
  std::vector<uint8_t> interaction, kind;
  std::vector<int64_t> surface, vehicle;
  std::vector<size_t> rows;
  const auto end_of_path = [&] {
    interaction.push_back(0);
    surface.push_back(-1);
    vehicle.push_back(-1);
  };
  for (size_t i = 0; i < paths.size(); ++i) {
    const std::vector<glm::dvec3> line = path_points(frame, i);
    if (line.empty()) {
      ++left_out;
      continue;
    }
    for (const glm::dvec3& p : line) {
      connectivity.push_back(static_cast<int64_t>(points.size()));
      points.push_back(p);
    }
    ends.push_back(static_cast<int64_t>(points.size()));
    end_of_path();
    for (size_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k) {
      interaction.push_back(paths.vertex_interaction[k]);
      surface.push_back(paths.vertex_surface[k]);
      vehicle.push_back(paths.vertex_instance[k] == no_instance ? -1 : int64_t{paths.vertex_instance[k]});
    }
    end_of_path();
    rows.push_back(i);
    kind.push_back(static_cast<uint8_t>(path_kind(paths, i)));
  }
  VtkFile file;
  file.add_points(points);
  file.add_cells(VtkFile::lines, connectivity, ends);
  const auto add_column = [&](const char* name, const auto& column) {
    std::remove_cvref_t<decltype(column)> values;
    for (const size_t row : rows) values.push_back(column[row]);
    file.add(VtkFile::cell_data, name, values);
  };
  add_column("gain_db", paths.gain_db);
  add_column("delay_s", paths.delay_s);
  add_column("doppler_hz", paths.doppler_hz);
  add_column("depth", paths.depth);
  add_column("tx", paths.tx);
  add_column("rx", paths.rx);
  file.add(VtkFile::cell_data, "kind", kind);
  file.add(VtkFile::point_data, "interaction", interaction);
  file.add(VtkFile::point_data, "surface", surface);
  file.add(VtkFile::point_data, "vehicle", vehicle);
  std::vector<std::string> kind_names;
  for (const PathKind& each : path_kinds) kind_names.emplace_back(each.word);
  file.add(VtkFile::field_data, "kind_names", kind_names);
  file.add(VtkFile::field_data, "tx_names", names_of(run.transmitters(), &RadioEnd::name));
  file.add(VtkFile::field_data, "rx_names", names_of(run.receivers(), &RadioEnd::name));
  add_time(file, frame);
  return file;
}

}  // namespace

Written export_vtk(const SavedRun& run, const ExportOptions& options, Warnings& warnings) {
  const SavedWorld world = load_saved_world(run, true);
  warnings.insert(warnings.end(), world.warnings.begin(), world.warnings.end());
  const std::optional<SavedWaypoints> waypoints = saved_waypoints(run);
  PendingFolder folder(options.output);
  std::vector<std::string> names{"run.pvd"}, constant;
  if (!world.scene.triangles.empty()) {
    put(folder, "scene.vtp", scene_file(world.scene));
    constant.push_back("scene.vtp");
  }
  if (!world.scene.volumes.empty()) {
    put(folder, "vegetation.vtp", vegetation_file(world.scene));
    constant.push_back("vegetation.vtp");
  }
  if (VtkFile edges; add_edges(edges, world.scene, world.config.trace.free_edges)) {
    put(folder, "edges.vtp", edges);
    constant.push_back("edges.vtp");
  }
  names.insert(names.end(), constant.begin(), constant.end());
  std::string times;
  size_t left_out = 0;
  for (size_t row = options.first_row; row <= options.last_row; ++row) {
    options.tell(row);
    const SavedFrame frame = run.frame(row);
    std::vector<std::string> parts = constant;
    const auto add_part = [&](const char* kind, const VtkFile& file) {
      parts.push_back(fmt::format("{}_{:05}.vtp", kind, frame.number));
      names.push_back(parts.back());
      put(folder, parts.back(), file);
    };
    if (!run.instances().empty()) add_part("vehicles", vehicles_file(run, world, frame));
    add_part("ends", ends_file(run, frame));
    add_part("paths", paths_file(run, frame, left_out));
    if (waypoints) {
      VtkFile rays = rays_file(waypoints->frame(frame.number));
      add_time(rays, frame);
      add_part("rays", rays);
    }
    for (size_t i = 0; i < parts.size(); ++i)
      times += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", frame.time_s, i, parts[i]);
  }
  folder.append("run.pvd", "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n" +
                               times + "</Collection>\n</VTKFile>\n");
  if (left_out > 0)
    warnings.push_back(fmt::format("vtk: {} paths with points that are not finite are left out", left_out));
  const std::filesystem::path place = folder.commit();
  Written written;
  for (const std::string& name : names) written.push_back(place / name);
  return written;
}

}  // namespace wavetracer
