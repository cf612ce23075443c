// SPDX-License-Identifier: Apache-2.0
// The columns of frames in wavetracer.h: each is a row of a table.
#include <string_view>
#include "library/column_view.hpp"
#include "library/handles.hpp"

namespace wavetracer::c_api {
namespace {

template <auto Member>
wavetracer_column of_paths(const wavetracer_frame& frame) {
  return view(frame.result.paths.*Member);
}

wavetracer_column coefficients(const wavetracer_frame& frame) {
  const Paths& paths = frame.result.paths;
  return checked({frame.a.data(), paths.size(), size_t{paths.rx_ports} * paths.tx_ports, WAVETRACER_COMPLEX128});
}

template <auto Member>
wavetracer_column of_carriers(const wavetracer_frame& frame) {
  const CarrierColumns& carriers = frame.carriers;
  return checked({(carriers.*Member).data(), carriers.carriers ? frame.result.paths.size() : 0, carriers.carriers,
                  WAVETRACER_FLOAT64});
}

wavetracer_column carrier_coefficients(const wavetracer_frame& frame) {
  const Paths& paths = frame.result.paths;
  const size_t carriers = frame.carriers.carriers;
  return checked({frame.carriers.a.data(), carriers ? paths.size() : 0, carriers * paths.rx_ports * paths.tx_ports,
                  WAVETRACER_COMPLEX128});
}

wavetracer_column responses(const wavetracer_frame& frame) {
  const Responses& all = frame.result.responses;
  return checked(
      {all.h.data(), all.frequencies ? all.h.size() / all.frequencies : 0, all.frequencies, WAVETRACER_COMPLEX64});
}

template <auto Member>
wavetracer_column of_beams(const wavetracer_frame& frame) {
  return view(frame.result.beams.*Member);
}

template <auto Member>
wavetracer_column of_links(const wavetracer_frame& frame) {
  return view(frame.links.*Member);
}

template <auto Member>
wavetracer_column of_radars(const wavetracer_frame& frame) {
  return view(frame.radars.*Member);
}

template <auto Member>
wavetracer_column of_detections(const wavetracer_frame& frame) {
  return view(frame.radars.detections.*Member);
}

struct Row {
  const char* name;
  wavetracer_column (*read)(const wavetracer_frame&);
};

constexpr Row rows[] = {
    {"frame", of_paths<&Paths::frame>},
    {"tx", of_paths<&Paths::tx>},
    {"rx", of_paths<&Paths::rx>},
    {"depth", of_paths<&Paths::depth>},
    {"delay_s", of_paths<&Paths::delay_s>},
    {"gain_db", of_paths<&Paths::gain_db>},
    {"a", coefficients},
    {"aod_theta_rad", of_paths<&Paths::aod_theta_rad>},
    {"aod_phi_rad", of_paths<&Paths::aod_phi_rad>},
    {"aoa_theta_rad", of_paths<&Paths::aoa_theta_rad>},
    {"aoa_phi_rad", of_paths<&Paths::aoa_phi_rad>},
    {"doppler_hz", of_paths<&Paths::doppler_hz>},
    {"quarters", of_paths<&Paths::quarters>},
    {"target", of_paths<&Paths::target>},
    {"group", of_paths<&Paths::group>},
    {"group_weight", of_paths<&Paths::group_weight>},
    {"lifetime_m", of_paths<&Paths::lifetime_m>},
    {"vertex_offset", of_paths<&Paths::vertex_offset>},
    {"vertex_position_m", of_paths<&Paths::vertex_position_m>},
    {"vertex_interaction", of_paths<&Paths::vertex_interaction>},
    {"vertex_surface", of_paths<&Paths::vertex_surface>},
    {"vertex_instance", of_paths<&Paths::vertex_instance>},
    {"link", [](const wavetracer_frame& frame) { return view(frame.result.world.links); }},
    {"link_paths", of_links<&LinkColumns::paths>},
    {"link_los", of_links<&LinkColumns::los>},
    {"link_path_gain_db", of_links<&LinkColumns::path_gain_db>},
    {"link_sum_of_powers_db", of_links<&LinkColumns::sum_of_powers_db>},
    {"link_narrowband_gain_db", of_links<&LinkColumns::narrowband_gain_db>},
    {"link_mean_delay_s", of_links<&LinkColumns::mean_delay_s>},
    {"link_rms_delay_spread_s", of_links<&LinkColumns::rms_delay_spread_s>},
    {"link_doppler_spread_hz", of_links<&LinkColumns::doppler_spread_hz>},
    {"link_missed_power_share", of_links<&LinkColumns::missed_power_share>},
    {"carrier_a", carrier_coefficients},
    {"carrier_gain_db", of_carriers<&CarrierColumns::gain_db>},
    {"carrier_doppler_hz", of_carriers<&CarrierColumns::doppler_hz>},
    {"response", responses},
    {"response_offset", [](const wavetracer_frame& frame) { return view(frame.result.responses.row_offset); }},
    {"beam_tx", of_beams<&BeamRows::tx>},
    {"beam_rx", of_beams<&BeamRows::rx>},
    {"beam_tx_beam", of_beams<&BeamRows::tx_beam>},
    {"beam_rx_beam", of_beams<&BeamRows::rx_beam>},
    {"beam_gain_db", of_beams<&BeamRows::gain_db>},
    {"radar", of_radars<&RadarColumns::radar>},
    {"radar_tx", of_radars<&RadarColumns::tx>},
    {"radar_rx", of_radars<&RadarColumns::rx>},
    {"radar_left_out", of_radars<&RadarColumns::left_out>},
    {"detection_offset", of_radars<&RadarColumns::detection_offset>},
    {"detection_range_m", of_detections<&RadarDetections::range_m>},
    {"detection_delay_s", of_detections<&RadarDetections::delay_s>},
    {"detection_speed_m_s", of_detections<&RadarDetections::speed_m_s>},
    {"detection_doppler_hz", of_detections<&RadarDetections::doppler_hz>},
    {"detection_power_dbm", of_detections<&RadarDetections::power_dbm>},
    {"detection_threshold_dbm", of_detections<&RadarDetections::threshold_dbm>},
    {"detection_azimuth_rad", of_detections<&RadarDetections::azimuth_rad>},
    {"detection_elevation_rad", of_detections<&RadarDetections::elevation_rad>},
    {"transmitter_position_m", [](const wavetracer_frame& frame) { return view(frame.transmitter_position_m); }},
    {"receiver_position_m", [](const wavetracer_frame& frame) { return view(frame.receiver_position_m); }},
};

}  // namespace
}  // namespace wavetracer::c_api

using namespace wavetracer::c_api;

extern "C" {

int wavetracer_frame_column(const wavetracer_frame* self, const char* name, wavetracer_column* column,
                            wavetracer_error** error) {
  return guarded(error, 0, [&] {
    const char* const here = "wavetracer_frame_column";
    const std::string_view wanted = &needed(name, here, "name");
    needed(self, here, "self");
    needed(column, here, "column");
    for (const Row& row : rows) {
      if (wanted != row.name) continue;
      *column = row.read(*self);
      return 1;
    }
    throw wavetracer::ConfigError("there is no column \"" + std::string(wanted) + "\"; wavetracer.h lists them");
  });
}

size_t wavetracer_column_count(void) { return std::size(rows); }
const char* wavetracer_column_name(size_t index) { return index < std::size(rows) ? rows[index].name : nullptr; }

}  // extern "C"
