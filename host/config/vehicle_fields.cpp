// Rows of the field table about vehicles: their trajectories, bodies and antennas, the frames and links of a drive.
// The reason for each default stands in the doc of its row; the default itself is the initialiser in config.hpp.
#include <utility>

#include "config/field_rows.hpp"

namespace wavetracer::config {

Table trajectories_table() {
  const auto t = [](auto member) { return at(&Config::trajectories, member); };
  return {.name = "trajectories",
          .doc = "How vehicles move: file, generate or [[track]] tables; none of them, no vehicles.",
          .fields = {
              {.name = "file",
               .slot = t(&TrajectoriesConfig::file),
               .form = Form::input_file,
               .doc = "SUMO's floating car data (--fcd-output), or CSV with a header that names time, id, x, y and "
                      "perhaps z, yaw, speed, type; plain or gzip."},
              {.name = "generate",
               .slot = t(&TrajectoriesConfig::generate),
               .doc = "Traffic made on the spot instead of a file, in the streets of the city that scene.generate "
                      "makes: --blocks, --block-m and --street-m must be the same.",
               .example = "\"--seed 1 --blocks 4 --vehicles 10 --seconds 1 --step 0.1\""},
              {.name = "offset_m",
               .slot = t(&TrajectoriesConfig::offset_m),
               .unit = "m",
               .doc = "Scene file coordinates = scale * coordinates of trajectories.file + offset_m. SUMO moves its "
                      "networks by a netOffset; minus that brings them back."},
              {.name = "scale",
               .slot = t(&TrajectoriesConfig::scale),
               .range = {0, 1e6, true},
               .doc = "Of the positions in trajectories.file alone: SUMO's sizes and speeds are in metres."},
              {.name = "persons",
               .slot = t(&TrajectoriesConfig::persons),
               .doc = "Read the persons of a file too, as person:ID. They carry antennas but have no body."},
              {.name = "containers",
               .slot = t(&TrajectoriesConfig::containers),
               .doc = "Read the containers of a file too, as container:ID."},
              {.name = "default_type",
               .slot = t(&TrajectoriesConfig::default_type),
               .doc = "Vehicle type of vehicles whose own is neither a [[vehicle_type]] nor a class of SUMO. Left "
                      "empty, such a vehicle is an error, because a guess of its size would be wrong in silence."},
          }};
}

Table time_table() {
  const auto t = [](auto member) { return at(&Config::time, member); };
  return {.name = "time",
          .doc = "The frames of a drive. Without vehicles there is one frame, at 0 s.",
          .fields = {
              {.name = "start_s",
               .slot = t(&TimeConfig::start_s),
               .unit = "s",
               .doc = "Of the first frame. Not given: the first sample of the trajectories.",
               .example = "0.0"},
              {.name = "end_s",
               .slot = t(&TimeConfig::end_s),
               .unit = "s",
               .doc = "No frame is later. Not given: the last sample of the trajectories.",
               .example = "1.0"},
              {.name = "step_s",
               .slot = t(&TimeConfig::step_s),
               .unit = "s",
               .range = {0, 1e9},
               .none = "0",
               .doc = "Between frames; poses between samples are interpolated smoothly. 0: the step of the "
                      "trajectories."},
          }};
}

Table links_table() {
  const auto l = [](auto member) { return at(&Config::links, member); };
  return {.name = "links",
          .doc = "Which pairs of a transmitter and a receiver are computed. Never those of one place on one vehicle.",
          .fields = {
              {.name = "max_distance_m",
               .slot = l(&LinksConfig::max_distance_m),
               .unit = "m",
               .range = {0, infinity, true},
               .doc = "Between the two ends, straight; inf, because only the user knows what is too far."},
              {.name = "transmitters",
               .slot = l(&LinksConfig::transmitters),
               .doc = "Names, with * for any text and ? for any character; those of mounts are VEHICLE/NAME."},
              {.name = "receivers", .slot = l(&LinksConfig::receivers), .doc = "Names, in the same way."},
              {.name = "v2v", .slot = l(&LinksConfig::v2v), .doc = "Links between two vehicles."},
              {.name = "v2i",
               .slot = l(&LinksConfig::v2i),
               .doc = "Links between a vehicle and an end that stands, either way."},
              {.name = "i2i", .slot = l(&LinksConfig::i2i), .doc = "Links between ends that stand."},
              {.name = "same_vehicle",
               .slot = l(&LinksConfig::same_vehicle),
               .doc = "Links between two antennas of one vehicle, whatever v2v says. false: they are wired."},
          }};
}

Table mount_table() {
  const auto m = [](auto member) { return at(&Config::mounts, member); };
  return {
      .name = "mount",
      .doc = "An antenna on every vehicle of a kind; one table each.",
      .fields =
          {
              {.name = "name",
               .slot = m(&MountConfig::name),
               .required = true,
               .doc = "Unique among mounts. The radio end is called VEHICLE/NAME.",
               .example = "\"roof\""},
              {.name = "on",
               .slot = m(&MountConfig::on),
               .doc = "Id or type of the vehicles that have it, with * for any text and ? for any character."},
              {.name = "role", .slot = m(&MountConfig::role), .doc = "What it is; both, as radios of vehicles are."},
              {.name = "offset_m",
               .slot = m(&MountConfig::offset_m),
               .unit = "m",
               .doc = "Ahead, left, up from the centre of the vehicle's footprint.",
               .example = "[0.0, 0.0, 1.6]"},
              antenna_field(m, &MountConfig::antenna),
              polarization_field(m, &MountConfig::polarization),
              {.name = "orientation_deg",
               .slot = m(&MountConfig::orientation_deg),
               .unit = "degrees",
               .doc = "Yaw, pitch, roll in the axes of the vehicle: intrinsic rotations about z, y, x."},
          },
      .append = append<&Config::mounts>,
      .count = count<&Config::mounts>,
      .optional = true};
}

Table vehicle_type_table() {
  const auto v = [](auto member) { return at(&Config::vehicle_types, member); };
  const auto size = [&](std::string name, auto member, std::string along) -> Field {
    return {.name = std::move(name),
            .slot = v(member),
            .unit = "m",
            .range = {0, 1000},
            .none = "0",
            .doc = std::move(along) + ". 0: that of the mesh file, else that of SUMO's vehicle class of this name."};
  };
  return {.name = "vehicle_type",
          .doc =
              "What a vehicle type of the trajectories looks like; one table each. Types that SUMO's classes name "
              "need none.",
          .fields =
              {
                  {.name = "name",
                   .slot = v(&VehicleTypeConfig::name),
                   .required = true,
                   .doc = "As in the trajectories; unique.",
                   .example = "\"passenger\""},
                  {.name = "model",
                   .slot = v(&VehicleTypeConfig::model),
                   .choices = {NamedBody::words.begin(), NamedBody::words.end()},
                   .form = Form::choice_or_file,
                   .doc = "Its body, or a mesh file in metres (x ahead, z up, origin on the ground below the centre), "
                          "stretched to the sizes that are given. auto: by the name of the type; none for two-wheelers "
                          "and persons. Antennas need no body."},
                  size("length_m", &VehicleTypeConfig::length_m, "Along the vehicle"),
                  size("width_m", &VehicleTypeConfig::width_m, "Across it"),
                  size("height_m", &VehicleTypeConfig::height_m, "From the ground up"),
                  {.name = "material",
                   .slot = v(&VehicleTypeConfig::material),
                   .doc = "Radio material of the meshes of a file that name none."},
              },
          .append = append<&Config::vehicle_types>,
          .count = count<&Config::vehicle_types>,
          .optional = true};
}

Table track_table() {
  const auto t = [](auto member) { return at(&Config::tracks, member); };
  return {
      .name = "track",
      .doc = "A vehicle on waypoints, smoothly connected; one table each, with or without other trajectories.",
      .fields =
          {
              {.name = "id",
               .slot = t(&TrackConfig::id),
               .required = true,
               .doc = "Unique among vehicles.",
               .example = "\"ego\""},
              {.name = "type", .slot = t(&TrackConfig::type), .doc = "A [[vehicle_type]], or a vehicle class of SUMO."},
              {.name = "waypoints",
               .slot = t(&TrackConfig::waypoints),
               .unit = "s, m, m, m",
               .required = true,
               .doc = "[time, x, y, z] each, time increasing, in the coordinates of the scene file; the centre of "
                      "the footprint, on the ground.",
               .example = "[[0.0, -50.0, -3.0, 0.0], [5.0, 0.0, -3.0, 0.0]]"},
          },
      .append = append<&Config::tracks>,
      .count = count<&Config::tracks>,
      .optional = true};
}

}  // namespace wavetracer::config
