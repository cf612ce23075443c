// SPDX-License-Identifier: Apache-2.0
// Writes datasets of fixed and moving objects of the world. An end that is absent from a frame has NaN for a position.
// Every frame must have all ends and instances of the run.
#include "output/world_h5.hpp"
#include <array>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>

namespace wavetracer {
namespace {

using hdf5::Meaning;
using hdf5::Rows;

void append(std::vector<double>& values, const glm::dvec3& v) { values.insert(values.end(), {v.x, v.y, v.z}); }

void write_configured(hdf5::File& file, const std::string& path, const std::string& description,
                      const std::vector<RadioEnd>& ends) {
  const auto group = file.make_group(path, description);
  const auto text = [&](const char* name, const char* meaning, const auto& field) {
    std::vector<std::string> values;
    for (const RadioEnd& end : ends) values.emplace_back(std::invoke(field, end));
    file.write_strings(path + "/" + name, {"1", meaning}, values);
  };
  const auto triple = [&](const char* name, const Meaning& meaning, std::array<double, 3> RadioEnd::*field) {
    Rows<double> table(file, path + "/" + name, meaning, {ends.size(), 3});
    for (const RadioEnd& end : ends) table.append(end.*field);
  };
  text("name", "name given in the config; VEHICLE/MOUNT where it is mounted on a vehicle", &RadioEnd::name);
  triple("position_m",
         {"m", "position in the coordinates of the scene file, (x, y, z); of an end on a vehicle see /frames"},
         &RadioEnd::position_m);
  text("antenna", "antenna pattern, or the file that holds it", &RadioEnd::antenna);
  text("polarization", "V, H, VH (two ports: V, H) or cross (two ports: +45 deg, -45 deg)",
       [](const RadioEnd& end) { return end.polarization.word(); });
  triple("orientation_deg",
         {"deg", "(yaw, pitch, roll), intrinsic rotations about z, y, x; in the vehicle's axes where it is on one"},
         &RadioEnd::orientation_deg);
  triple("velocity_m_s",
         {"m/s", "velocity along the axes of the scene file, (x, y, z); of an end on a vehicle see /frames"},
         &RadioEnd::velocity_m_s);
}

// Appends positions and velocities of one kind of ends, (end, 3).
void append_motion(const Run& run, const std::vector<EndState>& ends, const std::string& kind, FrameTables& tables) {
  const std::string shape = "; shape (frame, " + kind + ", 3), NaN while it is absent";
  const glm::dvec3 nowhere(std::numeric_limits<double>::quiet_NaN());
  std::vector<double> position_m, velocity_m_s;
  for (const EndState& end : ends) {
    append(position_m, end.present ? run.scene.origin_m + end.position_m : nowhere);
    append(velocity_m_s, end.present ? end.velocity_m_s : nowhere);
  }
  tables.append_row<double>(kind + "_position_m", {"m", "position in the coordinates of the scene file" + shape},
                            position_m, {ends.size(), 3});
  tables.append_row<double>(kind + "_velocity_m_s", {"m/s", "velocity along the axes of the scene file" + shape},
                            velocity_m_s, {ends.size(), 3});
}

}  // namespace

void write_instances(hdf5::File& file, const Run& run) {
  const auto group = file.make_group("/instances", "one row per vehicle, whatever the frame");
  const auto text = [&](const char* name, const char* meaning, auto value) {
    std::vector<std::string> values;
    for (const Instance& instance : run.instances) values.push_back(value(instance));
    file.write_strings(std::string("/instances/") + name, {"1", meaning}, values);
  };
  text("id", "id of the vehicle in its trajectory", [](const Instance& instance) { return instance.id; });
  text("type", "type of the vehicle in its trajectory", [](const Instance& instance) { return instance.type; });
  text("model", "what it looks like: a mesh file, or the name of a built-in shape",
       [&run](const Instance& instance) { return run.models[instance.model].file; });
}

void write_targets(hdf5::File& file, const Run& run) {
  if (run.targets.empty()) return;
  const auto group = file.make_group("/targets", "one row per target of sensing, whatever the frame");
  std::vector<std::string> names, models;
  Rows<uint32_t> instances(file, "/targets/instance",
                           {"1", "row of /instances, the body of its vehicle; 4294967295 without one"},
                           {run.targets.size()});
  for (const SensedTarget& target : run.targets) {
    names.push_back(target.name);
    models.push_back(target.model);
    instances.append(std::array{target.instance});
  }
  file.write_strings("/targets/name", {"1", "name given in the config; VEHICLE/MODEL of a vehicle"}, names);
  file.write_strings("/targets/model", {"1", "its [[target_model]] in the config"}, models);
}

void write_ends(hdf5::File& file, const Run& run) {
  write_configured(file, "/transmitters", "one row per transmitter: those of the config, then those on vehicles",
                   run.config.transmitters);
  write_configured(file, "/receivers", "one row per receiver: those of the config, then those on vehicles",
                   run.config.receivers);
}

void append_frame(const Run& run, const FrameResult& frame, FrameTables& tables) {
  tables.group("/frames", "one row per frame");
  const std::array<uint64_t, 2> offset{0, frame.paths.size()};
  tables.append<uint32_t>("frame", {"1", "number of the frame"}, {&frame.frame, 1});
  tables.append<double>("time_s", {"s", "time of the frame"}, {&frame.world.time_s, 1});
  tables.append<uint64_t>("path_offset",
                          {"1", "the paths of frame row i are rows path_offset[i] to path_offset[i + 1] - 1 of /paths"},
                          offset);
  append_motion(run, frame.world.transmitters, "transmitter", tables);
  append_motion(run, frame.world.receivers, "receiver", tables);
}

void append_poses(const Run& run, const FrameResult& frame, FrameTables& tables) {
  std::vector<uint32_t> instances;
  std::vector<double> positions_m, rotations, velocities_m_s;
  for (size_t i = 0; i < frame.world.instances.size(); ++i) {
    const Placement& placed = frame.world.instances[i];
    if (!placed.present) continue;
    instances.push_back(static_cast<uint32_t>(i));
    // The origin of the model's file, which lies at -origin_m in its Scene.
    const glm::dvec3 arm_m = placed.rotation * -run.models[run.instances[i].model].origin_m;
    append(positions_m, run.scene.origin_m + placed.position_m + arm_m);
    append(velocities_m_s, placed.velocity_m_s + glm::cross(placed.angular_velocity_rad_s, arm_m));
    for (int row = 0; row < 3; ++row)
      // Glm stores matrices by column.
      for (int column = 0; column < 3; ++column) rotations.push_back(placed.rotation[column][row]);
  }
  const std::vector<uint32_t> numbers(instances.size(), frame.frame);
  tables.group("/poses", "one row per frame and vehicle that is present in it, sorted so");
  tables.append<uint32_t>("frame", {"1", "number of the frame, see /frames/frame"}, numbers);
  tables.append<uint32_t>("instance", {"1", "row of /instances"}, instances);
  tables.append<double>("position_m",
                        {"m", "the origin of the model's file in the coordinates of the scene file, (x, y, z)"},
                        positions_m, {3});
  tables.append<double>(
      "rotation",
      {"1", "R of p_scene = position_m + R p_model, shape (pose, row, column); p_model in the model's file"}, rotations,
      {3, 3});
  tables.append<double>("velocity_m_s", {"m/s", "velocity of position_m along the axes of the scene file"},
                        velocities_m_s, {3});
}

void append_links(const FrameResult& frame, FrameTables& tables) {
  const std::vector<uint32_t> numbers(frame.world.links.size(), frame.frame);
  std::vector<uint32_t> tx, rx;
  for (const Link& link : frame.world.links) {
    tx.push_back(link.tx);
    rx.push_back(link.rx);
  }
  tables.group("/links",
               "one row per frame and link that was asked for, with paths or without, sorted by frame, tx, rx");
  tables.append<uint32_t>("frame", {"1", "number of the frame, see /frames/frame"}, numbers);
  tables.append<uint32_t>("tx", {"1", "row of /transmitters"}, tx);
  tables.append<uint32_t>("rx", {"1", "row of /receivers"}, rx);
}

}  // namespace wavetracer
