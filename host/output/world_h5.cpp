// Datasets of what stands and moves in the world. An end that is absent from a frame has NaN for a position.
// Assumes that every frame knows all ends and instances of the run.
#include "output/world_h5.hpp"
#include <glm/geometric.hpp>
#include <limits>

namespace wavetracer {
namespace {

using hdf5::Meaning;
using hdf5::Rows;

template <typename T>
void write_values(const hdf5::File& file, const std::string& path, const Meaning& meaning,
                  const std::vector<T>& values, const std::vector<hsize_t>& row_shape = {}) {
  hsize_t rows = values.size();
  for (const hsize_t n : row_shape) rows /= n;
  std::vector<hsize_t> shape{rows};
  shape.insert(shape.end(), row_shape.begin(), row_shape.end());
  Rows<T>(file, path, meaning, shape).append(values);
}

void append(std::vector<double>& values, const glm::dvec3& v) { values.insert(values.end(), {v.x, v.y, v.z}); }

void write_configured(hdf5::File& file, const std::string& path, const std::string& description,
                      const std::vector<RadioEnd>& ends) {
  const auto group = file.make_group(path, description);
  const auto text = [&](const char* name, const char* meaning, std::string RadioEnd::*field) {
    std::vector<std::string> values;
    for (const RadioEnd& end : ends) values.push_back(end.*field);
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
  text("polarization", "V, H, VH (two ports: V, H) or cross (two ports: +45 deg, -45 deg)", &RadioEnd::polarization);
  triple("orientation_deg",
         {"deg", "(yaw, pitch, roll), intrinsic rotations about z, y, x; in the vehicle's axes where it is on one"},
         &RadioEnd::orientation_deg);
  triple("velocity_m_s",
         {"m/s", "velocity along the axes of the scene file, (x, y, z); of an end on a vehicle see /frames"},
         &RadioEnd::velocity_m_s);
}

// Positions and velocities of one kind of ends, (frame, end, 3).
void write_motion(const hdf5::File& file, const Run& run, Frames frames, const std::string& kind, size_t count,
                  std::vector<EndState> WorldState::*ends) {
  const std::string shape = "; shape (frame, " + kind + ", 3), NaN while it is absent";
  Rows<double> positions(file, "/frames/" + kind + "_position_m",
                         {"m", "position in the coordinates of the scene file" + shape}, {frames.size(), count, 3}),
      velocities(file, "/frames/" + kind + "_velocity_m_s",
                 {"m/s", "velocity along the axes of the scene file" + shape}, {frames.size(), count, 3});
  const glm::dvec3 nowhere(std::numeric_limits<double>::quiet_NaN());
  std::vector<double> position_m, velocity_m_s;
  for (const FrameResult& frame : frames) {
    position_m.clear();
    velocity_m_s.clear();
    for (const EndState& end : frame.world.*ends) {
      append(position_m, end.present ? run.scene.origin_m + end.position_m : nowhere);
      append(velocity_m_s, end.present ? end.velocity_m_s : nowhere);
    }
    positions.append(position_m);
    velocities.append(velocity_m_s);
  }
}

}  // namespace

void write_instances(hdf5::File& file, const Run& run) {
  const auto group = file.make_group("/instances", "one row a vehicle, whatever the frame");
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

void write_ends(hdf5::File& file, const Run& run) {
  write_configured(file, "/transmitters", "one row a transmitter: those of the config, then those on vehicles",
                   run.config.transmitters);
  write_configured(file, "/receivers", "one row a receiver: those of the config, then those on vehicles",
                   run.config.receivers);
}

void write_frames(hdf5::File& file, const Run& run, Frames frames) {
  const auto group = file.make_group("/frames", "one row a frame");
  std::vector<uint32_t> numbers;
  std::vector<double> times_s;
  std::vector<uint64_t> offsets{0};
  for (const FrameResult& frame : frames) {
    numbers.push_back(frame.frame);
    times_s.push_back(frame.world.time_s);
    offsets.push_back(offsets.back() + frame.paths.size());
  }
  write_values(file, "/frames/frame", {"1", "number of the frame"}, numbers);
  write_values(file, "/frames/time_s", {"s", "time of the frame"}, times_s);
  write_values(file, "/frames/path_offset",
               {"1", "the paths of frame row i are rows path_offset[i] to path_offset[i + 1] - 1 of /paths"}, offsets);
  write_motion(file, run, frames, "transmitter", run.config.transmitters.size(), &WorldState::transmitters);
  write_motion(file, run, frames, "receiver", run.config.receivers.size(), &WorldState::receivers);
}

void write_poses(hdf5::File& file, const Run& run, Frames frames) {
  const auto group = file.make_group("/poses", "one row a frame and vehicle that is present in it, sorted so");
  std::vector<uint32_t> numbers, instances;
  std::vector<double> positions_m, rotations, velocities_m_s;
  for (const FrameResult& frame : frames) {
    for (size_t i = 0; i < frame.world.instances.size(); ++i) {
      const Placement& placed = frame.world.instances[i];
      if (!placed.present) continue;
      numbers.push_back(frame.frame);
      instances.push_back(static_cast<uint32_t>(i));
      // The origin of the model's file, which its Scene has at -origin_m.
      const glm::dvec3 arm_m = placed.rotation * -run.models[run.instances[i].model].origin_m;
      append(positions_m, run.scene.origin_m + placed.position_m + arm_m);
      append(velocities_m_s, placed.velocity_m_s + glm::cross(placed.angular_velocity_rad_s, arm_m));
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) rotations.push_back(placed.rotation[column][row]);  // glm: by column
    }
  }
  write_values(file, "/poses/frame", {"1", "number of the frame, see /frames/frame"}, numbers);
  write_values(file, "/poses/instance", {"1", "row of /instances"}, instances);
  write_values(file, "/poses/position_m",
               {"m", "the origin of the model's file in the coordinates of the scene file, (x, y, z)"}, positions_m,
               {3});
  write_values(file, "/poses/rotation",
               {"1", "R of p_scene = position_m + R p_model, shape (pose, row, column); p_model in the model's file"},
               rotations, {3, 3});
  write_values(file, "/poses/velocity_m_s", {"m/s", "velocity of position_m along the axes of the scene file"},
               velocities_m_s, {3});
}

void write_links(hdf5::File& file, Frames frames) {
  const auto group = file.make_group(
      "/links", "one row a frame and link that was asked for, with paths or without, sorted by frame, tx, rx");
  std::vector<uint32_t> numbers, tx, rx;
  for (const FrameResult& frame : frames)
    for (const Link& link : frame.world.links) {
      numbers.push_back(frame.frame);
      tx.push_back(link.tx);
      rx.push_back(link.rx);
    }
  write_values(file, "/links/frame", {"1", "number of the frame, see /frames/frame"}, numbers);
  write_values(file, "/links/tx", {"1", "row of /transmitters"}, tx);
  write_values(file, "/links/rx", {"1", "row of /receivers"}, rx);
}

}  // namespace wavetracer
