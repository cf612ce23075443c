// SPDX-License-Identifier: Apache-2.0
// Writes the traffic of a run as a trace of ASAM OSI 3: one GroundTruth message per frame, each after its length (four
// bytes, the lowest first). It contains only moving objects: vehicles with a body, by their bounding boxes.
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <protozero/pbf_writer.hpp>
#include "base/pending_file.hpp"
#include "convert/convert.hpp"
#include "convert/vtk_glb_kml.hpp"
#include "motion/osi_schema.hpp"
#include "results/saved_world.hpp"
#include "scene/georeference.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using protozero::pbf_writer;

std::string triple(const glm::dvec3& v) {
  std::string out;
  pbf_writer writer(out);
  writer.add_double(osi::triple::first, v.x);
  writer.add_double(osi::triple::second, v.y);
  writer.add_double(osi::triple::third, v.z);
  return out;
}

std::string identifier(uint64_t value) {
  std::string out;
  pbf_writer(out).add_uint64(osi::identifier::value, value);
  return out;
}

// The box of a vehicle in its own axes, starting at the ground.
struct VehicleBox {
  glm::dvec3 centre_m, size_m;
};

// Returns the box of a vehicle class, for vehicles whose body is not known any more.
std::optional<VehicleBox> box_of_class(const std::string& type) {
  const auto known = sumo_type(type);
  if (!known) return {};
  return VehicleBox{{0, 0, known->height_m / 2}, {known->length_m, known->width_m, known->height_m}};
}

VehicleBox box_of(const Scene& model) {
  glm::dvec3 lower = model.origin_m + model.lower, upper = model.origin_m + model.upper;
  lower.z = std::min(lower.z, 0.0);
  return {(lower + upper) / 2.0, upper - lower};
}

class OsiWriter {
 public:
  OsiWriter(const SavedRun& run, const SavedWorld& world, const ExportOptions& options)
      : run_(run), world_(world), file_(options.output) {
    // The scene's coordinates are those of the projection only if no option has moved them.
    if (!options.projection.empty())
      projection_ = options.projection;
    else if (const auto found = find_georeference(world.config.scene.file); found && found->offset_m == glm::dvec2(0))
      projection_ = found->projection;
  }

  void write(const ExportOptions& options, Warnings& warnings) {
    for (size_t row = options.first_row; row <= options.last_row; ++row) {
      options.tell(row);
      put(message_of(run_.frame(row)));
    }
    file_.sync();
    file_.commit();
    if (unknown_ > 0)
      warnings.push_back(fmt::format("osi: {} poses of vehicles whose body is not known have no size", unknown_));
    if (left_out_ > 0)
      warnings.push_back(fmt::format("osi: {} poses with numbers that are not finite are left out", left_out_));
  }

 private:
  void put(const std::string& message) {
    std::array<std::byte, 4> length;
    for (size_t k = 0; k < length.size(); ++k) length[k] = static_cast<std::byte>(message.size() >> 8 * k);
    file_.write(length);
    file_.write(std::as_bytes(std::span(message)));
  }

  std::string message_of(const SavedFrame& frame) {
    if (!(std::abs(frame.time_s) < 1e12))
      throw InputError(fmt::format("osi: frame {} is at {} s, which is no time", frame.number, frame.time_s));
    std::string out;
    pbf_writer writer(out);
    {
      pbf_writer version(writer, osi::ground_truth::version);
      version.add_uint32(osi::interface_version::major, osi::version[0]);
      version.add_uint32(osi::interface_version::minor, osi::version[1]);
      version.add_uint32(osi::interface_version::patch, osi::version[2]);
    }
    {
      const double whole_s = std::floor(frame.time_s);
      const int64_t nanos = std::llround((frame.time_s - whole_s) * 1e9), carry = nanos / 1000000000;
      const int64_t seconds = static_cast<int64_t>(whole_s) + carry;
      pbf_writer time(writer, osi::ground_truth::timestamp);
      time.add_int64(osi::timestamp::seconds, seconds);
      time.add_uint32(osi::timestamp::nanos, static_cast<uint32_t>(nanos - carry * 1000000000));
    }
    for (const SavedPose& pose : frame.poses) {
      if (is_finite(pose))
        writer.add_message(osi::ground_truth::moving_object, object_of(pose));
      else
        ++left_out_;
    }
    if (!projection_.empty()) writer.add_string(osi::ground_truth::proj_string, projection_);
    return out;
  }

  std::string object_of(const SavedPose& pose) {
    const SavedInstance& vehicle = run_.instances()[pose.instance];
    const osi::ObjectClass kind = osi::object_class(vehicle.type);
    std::string out;
    pbf_writer writer(out);
    writer.add_message(osi::moving_object::id, identifier(uint64_t{pose.instance} + 1));
    writer.add_message(osi::moving_object::base, base_of(pose));
    writer.add_enum(osi::moving_object::type, static_cast<int32_t>(kind.object));
    if (kind.vehicle > 0) {
      pbf_writer classification(writer, osi::moving_object::vehicle_classification);
      classification.add_enum(osi::vehicle_classification::type, static_cast<int32_t>(kind.vehicle));
    }
    {
      pbf_writer source(writer, osi::moving_object::source_reference);
      source.add_string(osi::external_reference::reference, std::string(osi::reference));
      source.add_string(osi::external_reference::type, std::string(osi::reference_type));
      source.add_string(osi::external_reference::identifier, vehicle.id);
      source.add_string(osi::external_reference::identifier, vehicle.type);
    }
    return out;
  }

  // Angles follow ISO 8855: rotations about z, then y, then x, so a positive pitch is nose down.
  std::string base_of(const SavedPose& pose) {
    const uint32_t model = world_.instance_model[pose.instance];
    const bool loaded = model != no_instance && !world_.models[model].triangles.empty();
    const std::optional<VehicleBox> box =
        loaded ? box_of(world_.models[model]) : box_of_class(run_.instances()[pose.instance].type);
    const glm::dvec3 &ahead = pose.rotation[0], &left = pose.rotation[1], &up = pose.rotation[2];
    std::string out;
    pbf_writer writer(out);
    if (box)
      writer.add_message(osi::base_moving::dimension, triple(box->size_m));
    else
      ++unknown_;
    writer.add_message(osi::base_moving::position,
                       triple(pose.position_m + pose.rotation * (box ? box->centre_m : glm::dvec3(0))));
    writer.add_message(
        osi::base_moving::orientation,
        triple({std::atan2(left.z, up.z), -std::asin(std::clamp(ahead.z, -1.0, 1.0)), std::atan2(ahead.y, ahead.x)}));
    writer.add_message(osi::base_moving::velocity, triple(pose.velocity_m_s));
    return out;
  }

  const SavedRun& run_;
  const SavedWorld& world_;
  PendingFile file_;
  std::string projection_;
  uint64_t unknown_ = 0, left_out_ = 0;
};

}  // namespace

Written export_osi(const SavedRun& run, const ExportOptions& options, Warnings& warnings) {
  if (run.instances().empty())
    throw InputError(
        fmt::format("osi: {} has no vehicles with a body, so there is no traffic to write", run.file().string()));
  const SavedWorld world = load_saved_world(run);
  warnings.insert(warnings.end(), world.warnings.begin(), world.warnings.end());
  OsiWriter(run, world, options).write(options, warnings);
  return {options.output};
}

}  // namespace wavetracer
