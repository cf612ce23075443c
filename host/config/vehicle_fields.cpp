// SPDX-License-Identifier: Apache-2.0
// Rows of the field table about vehicles: their trajectories, bodies and antennas, the frames and links of a drive. The
// doc of each row gives the reason for its default; the default itself is the initialiser in config.hpp.
#include <utility>

#include "config/field_rows.hpp"

namespace wavetracer::config {

Table trajectories_table() {
  const auto t = [](auto member) { return at(&Config::trajectories, member); };
  return {
      .name = "trajectories",
      .doc =
          "The motion of vehicles: from a file, generated, or by [[track]] tables. "
          "Without any of them there are no vehicles.",
      .fields = {
          {.name = "file",
           .slot = t(&TrajectoriesConfig::file),
           .form = Form::input_file,
           .doc = "Floating car data of SUMO (--fcd-output, XML or CSV), a GPX track, or CSV with a header "
                  "that names the columns time, id, x, y (or lat, lon in degrees) and optionally z, yaw, speed, type; "
                  "plain or compressed with gzip. Positions in degrees need a georeference.json beside "
                  "the scene file, and their heights are above the ground. docs/scenarios.md lists the other formats."},
          {.name = "generate",
           .slot = t(&TrajectoriesConfig::generate),
           .doc = "Generated traffic instead of a file, in the streets of the city that scene.generate makes: "
                  "--blocks, --block-m and --street-m must be the same in both.",
           .example = "\"--seed 1 --blocks 4 --vehicles 10 --seconds 1 --step 0.1\""},
          {.name = "offset_m",
           .slot = t(&TrajectoriesConfig::offset_m),
           .unit = "m",
           .range = places,
           .doc = "Scene file coordinates = scale * coordinates of trajectories.file + offset_m. "
                  "SUMO moves its networks by a netOffset; its negative value here moves them back."},
          {.name = "scale",
           .slot = t(&TrajectoriesConfig::scale),
           .range = {0, 1e6, true},
           .doc = "Factor for the positions in trajectories.file only: SUMO's sizes and speeds are in metres."},
          {.name = "above",
           .slot = t(&TrajectoriesConfig::above),
           .doc = "The reference of z in trajectories.file. zero: the zero of the scene file. "
                  "ground: the ground of the scene, so that vehicles of a flat network drive over hills; "
                  "slopes in the file are then not used."},
          {.name = "persons",
           .slot = t(&TrajectoriesConfig::persons),
           .doc = "Read the persons of the file too, as person:ID, with the body of a pedestrian."},
          {.name = "containers",
           .slot = t(&TrajectoriesConfig::containers),
           .doc = "Read the containers of the file too, as container:ID."},
          {.name = "default_type",
           .slot = t(&TrajectoriesConfig::default_type),
           .doc = "Vehicle type of vehicles whose own type is neither a [[vehicle_type]] nor a vehicle class "
                  "of SUMO. If this is empty, such a vehicle is an error, because a guess of its size could be "
                  "wrong without anybody noticing."},
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
               .range = instants,
               .doc = "Time of the first frame. Not given: the time of the first sample of the trajectories.",
               .example = "0.0"},
              {.name = "end_s",
               .slot = t(&TimeConfig::end_s),
               .unit = "s",
               .range = instants,
               .doc = "No frame is later than this. Not given: the time of the last sample of the trajectories.",
               .example = "1.0"},
              {.name = "step_s",
               .slot = t(&TimeConfig::step_s),
               .unit = "s",
               .range = {0, 1e9},
               .none = "0",
               .doc = "Time between frames; poses between samples are interpolated smoothly. "
                      "0: the time step of the trajectories."},
          }};
}

Table links_table() {
  const auto l = [](auto member) { return at(&Config::links, member); };
  return {
      .name = "links",
      .doc =
          "Selects the links (pairs of a transmitter and a receiver) that are computed. The two roles "
          "of one antenna are never linked, nor is a [[station]] to itself; a receiver at the place of a transmitter, "
          "under a name of its own, hears the echoes.",
      .fields = {
          {.name = "max_distance_m",
           .slot = l(&LinksConfig::max_distance_m),
           .unit = "m",
           .range = {0, infinity, true},
           .doc = "The largest straight distance between the two ends. The default is inf, "
                  "because only the user knows what is too far."},
          {.name = "transmitters",
           .slot = l(&LinksConfig::transmitters),
           .doc = "Names of transmitters, with * for any text and ? for any character; "
                  "the antennas of vehicles are called VEHICLE/MOUNT."},
          {.name = "receivers", .slot = l(&LinksConfig::receivers), .doc = "Names of receivers, in the same way."},
          {.name = "v2v", .slot = l(&LinksConfig::v2v), .doc = "Links between two vehicles."},
          {.name = "v2i",
           .slot = l(&LinksConfig::v2i),
           .doc = "Links between a vehicle and a fixed antenna, in both directions."},
          {.name = "i2i", .slot = l(&LinksConfig::i2i), .doc = "Links between fixed antennas."},
          {.name = "same_vehicle",
           .slot = l(&LinksConfig::same_vehicle),
           .doc = "Links between two antennas of the same vehicle, whatever v2v says. "
                  "false, because they are normally connected by a cable."},
      }};
}

Table mount_table() {
  const auto m = [](auto member) { return at(&Config::mounts, member); };
  return {.name = "mount",
          .doc = "An antenna on every vehicle that `on` selects; one table per antenna.",
          .fields =
              {
                  {.name = "name",
                   .slot = m(&MountConfig::name),
                   .required = true,
                   .doc = "Unique among mounts. The antenna is called VEHICLE/NAME.",
                   .example = "\"roof\""},
                  {.name = "on",
                   .slot = m(&MountConfig::on),
                   .doc = "Id or type of the vehicles that carry it, with * for any text and ? for any character."},
                  {.name = "role",
                   .slot = m(&MountConfig::role),
                   .doc = "The role of the antenna: it sends, receives or does both, as the radios of vehicles do."},
                  {.name = "offset_m",
                   .slot = m(&MountConfig::offset_m),
                   .unit = "m",
                   .range = places,
                   .doc = "Position relative to the centre of the vehicle's footprint, or to node: ahead, left, up.",
                   .example = "[0.0, 0.0, 1.6]"},
                  {.name = "above",
                   .slot = m(&MountConfig::above),
                   .doc = "The reference of the third number of offset_m. zero: the footprint of the vehicle, "
                          "along its own axes. ground: the ground of the scene below the antenna."},
                  {.name = "node",
                   .slot = m(&MountConfig::node),
                   .doc = "A named point of the vehicle's body from which offset_m counts: a node of its glTF "
                          "or OBJ file; built-in bodies have roof_antenna, front_antenna and rear_antenna.",
                   .example = "\"roof_antenna\""},
                  antenna_field(m, &MountConfig::antenna),
                  polarization_field(m, &MountConfig::polarization),
                  array_field(m, &MountConfig::array),
                  {.name = "orientation_deg",
                   .slot = m(&MountConfig::orientation_deg),
                   .unit = "degrees",
                   .range = angles,
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
            .doc = std::move(along) +
                   ". 0: the size of the mesh file, or else the size of SUMO's vehicle class of this name."};
  };
  return {.name = "vehicle_type",
          .doc =
              "The body of a vehicle type of the trajectories; one table per type. "
              "Types that are vehicle classes of SUMO need no table.",
          .fields =
              {
                  {.name = "name",
                   .slot = v(&VehicleTypeConfig::name),
                   .required = true,
                   .doc = "The name that the trajectories use; unique.",
                   .example = "\"passenger\""},
                  {.name = "model",
                   .slot = v(&VehicleTypeConfig::model),
                   .choices = {NamedBody::words.begin(), NamedBody::words.end()},
                   .form = Form::choice_or_file,
                   .doc = "A built-in body, or a mesh file in metres (x ahead, z up, origin on the ground below "
                          "the centre), which is stretched to the sizes that are given. "
                          "auto: chosen by the name of the type; "
                          "two-wheelers have a motorcycle with a rider. "
                          "A vehicle without a body can carry antennas too."},
                  size("length_m", &VehicleTypeConfig::length_m, "Length"),
                  size("width_m", &VehicleTypeConfig::width_m, "Width"),
                  size("height_m", &VehicleTypeConfig::height_m, "Height"),
                  {.name = "material",
                   .slot = v(&VehicleTypeConfig::material),
                   .doc = "Radio material of those meshes in the model file that name none."},
              },
          .append = append<&Config::vehicle_types>,
          .count = count<&Config::vehicle_types>,
          .optional = true};
}

Table parked_table() {
  const auto p = [](auto member) { return at(&Config::parked, member); };
  return {.name = "parked",
          .doc =
              "Vehicles that stand in all frames, called NAME/0, NAME/1, ...; one table per group. "
              "They reflect and block as others do.",
          .fields =
              {
                  {.name = "name",
                   .slot = p(&ParkedConfig::name),
                   .required = true,
                   .doc = "Unique among these tables.",
                   .example = "\"kerb\""},
                  {.name = "places",
                   .slot = p(&ParkedConfig::places),
                   .unit = "m, m, m, degrees",
                   .range = places,
                   .doc = "Each place is [x, y, z, yaw] in the coordinates of the scene file: "
                          "the centre of the footprint, on the ground, and the heading, counter-clockwise from +x.",
                   .example = "[[-20.0, 4.2, 0.0, 180.0], [-26.0, 4.2, 0.0, 180.0]]"},
                  {.name = "file",
                   .slot = p(&ParkedConfig::file),
                   .form = Form::input_file,
                   .doc = "Instead of places: CSV with a header that names the columns x, y and optionally z, yaw, "
                          "type, in the coordinates of the scene file."},
                  {.name = "type",
                   .slot = p(&ParkedConfig::type),
                   .doc = "A [[vehicle_type]], or a vehicle class of SUMO, for places that name none."},
                  {.name = "mounts",
                   .slot = p(&ParkedConfig::mounts),
                   .doc = "true: [[mount]] puts antennas on them, too. Normally the radios of parked cars are off."},
              },
          .append = append<&Config::parked>,
          .count = count<&Config::parked>,
          .optional = true};
}

Table track_table() {
  const auto t = [](auto member) { return at(&Config::tracks, member); };
  return {
      .name = "track",
      .doc =
          "A vehicle that moves through waypoints on a smooth curve; one table per vehicle, "
          "with or without other trajectories.",
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
               .range = instants,
               .required = true,
               .instead = "waypoints_wgs84",
               .doc = "Each waypoint is [time, x, y, z], with increasing times, in the coordinates of the scene file; "
                      "the position is the centre of the footprint, on the ground.",
               .example = "[[0.0, -50.0, -3.0, 0.0], [5.0, 0.0, -3.0, 0.0]]"},
              {.name = "waypoints_wgs84",
               .slot = t(&TrackConfig::waypoints_wgs84),
               .unit = "s, degrees, degrees, m",
               .range = instants,
               .doc = "Instead of waypoints: each is [time, latitude, longitude, height above the ground] (WGS84); "
                      "the vehicle follows the ground between them, too.",
               .example = "[[0.0, 48.137, 11.575, 0.0], [5.0, 48.137, 11.576, 0.0]]"},
              {.name = "above",
               .slot = t(&TrackConfig::above),
               .doc = "The reference of the z of waypoints. zero: it is that of the scene file. "
                      "ground: the ground of the scene, which the vehicle follows between waypoints, too."},
          },
      .append = append<&Config::tracks>,
      .count = count<&Config::tracks>,
      .optional = true};
}

}  // namespace wavetracer::config
