// SPDX-License-Identifier: Apache-2.0
// Writes KML 2.2: ends, vehicles and paths, frame by frame. Longitudes and latitudes are those of WGS 84; heights of
// the scene count as heights above the real ground. The run's 0 s is the first second of the year 2000; times from 1e9
// s on are seconds since 1970.
#include <fmt/format.h>
#include <chrono>
#include <cmath>
#include <map>
#include "base/pending_file.hpp"
#include "base/xml_text.hpp"
#include "convert/convert.hpp"
#include "convert/vtk_glb_kml.hpp"
#include "output/path_kinds.hpp"
#include "results/saved_world.hpp"
#include "scene/georeference.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// Google Earth becomes too slow beyond some ten thousand lines, so at most this many paths are written, spread evenly
// over the frames.
constexpr size_t max_paths_frame = 1000, max_paths = 50000;
constexpr size_t gain_classes = 12;   // steps of 5 dB
constexpr double since_1970_s = 1e9;  // from this time on, in 2001, times are taken as seconds since 1970
constexpr double latest_s = 2e11;     // the year 8307

Georeference place_of(const SavedWorld& world, const ExportOptions& options) {
  if (!options.projection.empty()) return {options.projection, {0, 0}, {}, {}};
  const std::string& scene = world.config.scene.file;
  if (const auto found = scene.empty() ? std::nullopt : find_georeference(scene)) return *found;
  throw InputError(fmt::format(
      "kml: where on the earth the scene is, is not known; give --projection with the PROJ string of its coordinates, "
      "such as \"+proj=tmerc +lat_0=48.14 +lon_0=11.57 +ellps=WGS84 +units=m\" (x east and y north of that point){}",
      scene.empty() ? "" : fmt::format(", or put a georeference.json beside {}", scene)));
}

std::string date(double time_s) {
  if (!(std::abs(time_s) < latest_s))
    throw InputError(fmt::format("kml: a frame is at {} s, which is no date", time_s));
  using namespace std::chrono;
  const auto begin = sys_days(year(time_s < since_1970_s ? 2000 : 1970) / 1 / 1);
  const auto time = begin + milliseconds(std::llround(time_s * 1000));
  const auto day = floor<days>(time);
  const year_month_day d(day);
  const hh_mm_ss clock(time - day);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", int(d.year()), unsigned(d.month()),
                     unsigned(d.day()), clock.hours().count(), clock.minutes().count(), clock.seconds().count(),
                     clock.subseconds().count());
}

// A first pass over all chosen frames: it finds the strongest path, and the ends that do not move.
struct Survey {
  GainScale gains;
  std::vector<uint8_t> transmitter_stays, receiver_stays;
  SavedFrame first;

  Survey(const SavedRun& run, const ExportOptions& options)
      : transmitter_stays(run.transmitters().size(), 1),
        receiver_stays(run.receivers().size(), 1),
        first(run.frame(options.first_row)) {
    for (size_t row = options.first_row; row <= options.last_row; ++row) {
      const SavedFrame frame = run.frame(row);
      gains.add(frame.paths);
      compare(transmitter_stays, first.transmitter_position_m, frame.transmitter_position_m);
      compare(receiver_stays, first.receiver_position_m, frame.receiver_position_m);
    }
  }
  static void compare(std::vector<uint8_t>& stays, const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    for (size_t i = 0; i < stays.size(); ++i) stays[i] &= a[i] == b[i];  // NaN for an absent end, which equals nothing
  }
};

class KmlWriter {
 public:
  KmlWriter(const SavedRun& run, const SavedWorld& world, const ExportOptions& options)
      : run_(run),
        world_(world),
        options_(options),
        place_(place_of(world, options)),
        projection_(place_),
        survey_(run, options),
        file_(options.output) {
    const size_t frames = options.last_row - options.first_row + 1;
    limit_ = std::clamp<size_t>(max_paths / frames, 1, max_paths_frame);
  }

  void write(Warnings& warnings);

 private:
  void put(const std::string& text) { file_.write(std::as_bytes(std::span(text))); }
  void put_styles();
  std::string coordinates(const glm::dvec3& p) const;
  // Heights of scenes with a terrain are above sea level, those of other scenes above their flat ground.
  std::string altitude_mode() const {
    return fmt::format("<altitudeMode>{}</altitudeMode>", place_.elevation_m ? "absolute" : "relativeToGround");
  }
  std::string point(const glm::dvec3& p) const;
  std::string times(size_t row) const;
  void put_placemark(const std::string& name, const std::string& span, const std::string& style,
                     const std::string& data, const std::string& geometry);
  void put_ends(const SavedFrame& frame, const std::string& span, bool staying);
  void put_vehicles(const SavedFrame& frame, const std::string& span);
  void put_paths(const SavedFrame& frame, const std::string& span);

  const SavedRun& run_;
  const SavedWorld& world_;
  const ExportOptions& options_;
  Georeference place_;
  Projection projection_;
  Survey survey_;
  PendingFile file_;
  size_t limit_ = 0;        // largest number of paths per frame
  uint64_t left_out_ = 0;   // paths left out because of the limit
  uint64_t not_drawn_ = 0;  // paths left out because of points that are not finite
};

std::string KmlWriter::coordinates(const glm::dvec3& p) const {
  const glm::dvec2 earth = projection_.geographic({p.x, p.y});
  if (!(std::abs(earth.x) <= 180 && std::abs(earth.y) <= 90))
    throw InputError(
        fmt::format("kml: x = {} m, y = {} m is not on the earth in \"{}\": is that the projection of "
                    "the scene's coordinates?",
                    p.x, p.y, place_.projection));
  return fmt::format("{:.9f},{:.9f},{:.4f}", earth.x, earth.y, p.z + place_.elevation_m.value_or(0));
}

std::string KmlWriter::point(const glm::dvec3& p) const {
  return "<Point>" + altitude_mode() + "<coordinates>" + coordinates(p) + "</coordinates></Point>";
}

// Returns the time span up to the next frame; the last frame is as long as the one before it. A single frame has no
// times.
std::string KmlWriter::times(size_t row) const {
  if (options_.first_row == options_.last_row) return "";
  const double begin_s = run_.time_s(row);
  const double end_s = row < options_.last_row ? run_.time_s(row + 1) : 2 * begin_s - run_.time_s(row - 1);
  return fmt::format("<TimeSpan><begin>{}</begin><end>{}</end></TimeSpan>", date(begin_s), date(end_s));
}

void KmlWriter::put_placemark(const std::string& name, const std::string& span, const std::string& style,
                              const std::string& data, const std::string& geometry) {
  put(fmt::format("<Placemark><name>{}</name>{}<styleUrl>#{}</styleUrl>{}{}</Placemark>\n", xml_text(name), span, style,
                  data.empty() ? "" : "<ExtendedData>" + data + "</ExtendedData>", geometry));
}

std::string data_of(const char* name, const std::string& value) {
  return fmt::format("<Data name=\"{}\"><value>{}</value></Data>", name, xml_text(value));
}

// Colours in KML are alpha, blue, green, red.
void KmlWriter::put_styles() {
  for (size_t k = 0; k < gain_classes; ++k) {
    const Colour c = gain_colour((static_cast<double>(k) + 0.5) / gain_classes);
    put(
        fmt::format("<Style id=\"gain_{}\"><LineStyle><color>ff{:02x}{:02x}{:02x}</color><width>2</width></LineStyle>"
                    "</Style>\n",
                    k, c[2], c[1], c[0]));
  }
  put("<Style id=\"transmitter\"><IconStyle><color>ff5d5dff</color></IconStyle></Style>\n"
      "<Style id=\"receiver\"><IconStyle><color>ffffd15a</color></IconStyle></Style>\n"
      "<Style id=\"station\"><IconStyle><color>ffff5dd1</color></IconStyle></Style>\n"
      "<Style "
      "id=\"vehicle\"><LineStyle><color>ffb0b0b0</color></LineStyle><PolyStyle><color>c0d8c8b8</color></PolyStyle>"
      "</Style>\n");
}

// A radio that sends and receives under one name becomes one placemark.
void KmlWriter::put_ends(const SavedFrame& frame, const std::string& span, bool staying) {
  std::map<std::string_view, const char*> styles;
  for (const RadioEnd& end : run_.transmitters()) styles[end.name] = "transmitter";
  for (const RadioEnd& end : run_.receivers()) {
    const auto [style, alone] = styles.try_emplace(end.name, "receiver");
    if (!alone) style->second = "station";
  }
  const auto put_kind = [&](bool second, const auto& ends, const auto& positions_m, const auto& stays) {
    for (size_t i = 0; i < ends.size(); ++i) {
      const std::string_view style = styles.at(ends[i].name);
      if (second && style == "station") continue;
      if ((stays[i] != 0) == staying && is_finite(positions_m[i]))
        put_placemark(ends[i].name, span, std::string(style), "", point(positions_m[i]));
    }
  };
  put_kind(false, run_.transmitters(), frame.transmitter_position_m, survey_.transmitter_stays);
  put_kind(true, run_.receivers(), frame.receiver_position_m, survey_.receiver_stays);
}

// Writes vehicles as boxes: the footprint of the body's bounding box, at the height of its roof, with walls down to the
// ground.
void KmlWriter::put_vehicles(const SavedFrame& frame, const std::string& span) {
  for (const SavedPose& pose : frame.poses) {
    if (!is_finite(pose)) continue;
    const SavedInstance& vehicle = run_.instances()[pose.instance];
    const uint32_t m = world_.instance_model[pose.instance];
    std::string geometry = point(pose.position_m);
    if (m != no_instance && !world_.models[m].triangles.empty()) {
      const Scene& model = world_.models[m];
      const glm::dvec3 &a = model.lower, &b = model.upper;
      std::string ring;
      for (const glm::dvec2& corner : {glm::dvec2(a.x, a.y), {b.x, a.y}, {b.x, b.y}, {a.x, b.y}, {a.x, a.y}})
        ring += coordinates(placed(pose, model, {corner.x, corner.y, b.z})) + " ";
      geometry = "<Polygon><extrude>1</extrude>" + altitude_mode() + "<outerBoundaryIs><LinearRing><coordinates>" +
                 ring + "</coordinates></LinearRing></outerBoundaryIs></Polygon>";
    }
    put_placemark(vehicle.id, span, "vehicle", data_of("type", vehicle.type), geometry);
  }
}

void KmlWriter::put_paths(const SavedFrame& frame, const std::string& span) {
  const Paths& paths = frame.paths;
  std::vector<size_t> rows(paths.size());
  for (size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  if (rows.size() > limit_) {
    const auto power = [&paths](size_t i) { return std::isnan(paths.gain_db[i]) ? -INFINITY : paths.gain_db[i]; };
    std::ranges::stable_sort(rows, std::ranges::greater(), power);
    left_out_ += rows.size() - limit_;
    rows.resize(limit_);
  }
  for (const size_t i : rows) {
    const std::vector<glm::dvec3> points = path_points(frame, i);
    if (points.empty()) {
      ++not_drawn_;
      continue;
    }
    std::string line;
    for (const glm::dvec3& p : points) line += coordinates(p) + " ";
    const auto shade = static_cast<size_t>(survey_.gains.place(paths.gain_db[i]) * gain_classes);
    put_placemark(fmt::format("{} to {}", run_.transmitters()[paths.tx[i]].name, run_.receivers()[paths.rx[i]].name),
                  span, fmt::format("gain_{}", std::min(shade, gain_classes - 1)),
                  data_of("gain_db", fmt::format("{:.2f}", paths.gain_db[i])) +
                      data_of("delay_ns", fmt::format("{:.3f}", paths.delay_s[i] * 1e9)) +
                      data_of("doppler_hz", fmt::format("{:.3f}", paths.doppler_hz[i])) +
                      data_of("kind", std::string(path_kinds[path_kind(paths, i)].word)),
                  "<LineString>" + altitude_mode() + "<coordinates>" + line + "</coordinates></LineString>");
  }
}

void KmlWriter::write(Warnings& warnings) {
  std::string description = "Paths are lines";
  if (!survey_.gains.empty())
    description += fmt::format(": from {:.0f} dB or less (dark) to {:.0f} dB (bright)", survey_.gains.weakest_db(),
                               survey_.gains.strongest_db());
  if (!place_.attribution.empty()) description += ". " + place_.attribution;
  put(fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\">\n<Document>\n"
      "<name>{}</name>\n<description>{}</description>\n",
      xml_text(options_.output.stem().string()), xml_text(description)));
  put_styles();
  const auto put_folder = [this](const char* name, const auto& content) {
    put(fmt::format("<Folder><name>{}</name>\n", name));
    content();
    put("</Folder>\n");
  };
  put_folder("ends that stay", [&] { put_ends(survey_.first, "", true); });
  for (size_t row = options_.first_row; row <= options_.last_row; ++row) {
    options_.tell(row);
    const SavedFrame frame = run_.frame(row);
    const std::string span = times(row);
    put_folder(fmt::format("frame {}", frame.number).c_str(), [&] {
      put_folder("ends", [&] { put_ends(frame, span, false); });
      put_folder("vehicles", [&] { put_vehicles(frame, span); });
      put_folder("paths", [&] { put_paths(frame, span); });
    });
  }
  put("</Document>\n</kml>\n");
  file_.sync();
  file_.commit();
  if (left_out_ > 0)
    warnings.push_back(
        fmt::format("kml: the {} strongest paths of each frame are written, {} are left out: "
                    "Google Earth shows no more than some {} lines",
                    limit_, left_out_, max_paths));
  if (not_drawn_ > 0)
    warnings.push_back(fmt::format("kml: {} paths with points that are not finite are left out", not_drawn_));
}

}  // namespace

Written export_kml(const SavedRun& run, const ExportOptions& options, Warnings& warnings) {
  const SavedWorld world = load_saved_world(run);
  warnings.insert(warnings.end(), world.warnings.begin(), world.warnings.end());
  KmlWriter(run, world, options).write(warnings);
  return {options.output};
}

}  // namespace wavetracer
