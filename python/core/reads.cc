// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/tagfield/foreign_tables.h"
#include "apps/tagfield/table.h"
#include "python/core/calls.h"
#include "python/core/loaded.h"
#include "python/core/tables.h"
#include "tagfield/base/spelling.h"
#include "tagfield/base/units.h"
#include "tagfield/calibration/calibration.h"
#include "tagfield/experiment/judge.h"
#include "tagfield/experiment/known_beforehand.h"
#include "tagfield/experiment/stoppable.h"
#include "tagfield/experiment/tracking_run.h"
#include "tagfield/files/read_overview.h"
#include "tagfield/scenario/calibration_profile.h"
#include "tagfield/scenario/driven_robot.h"

namespace tagfield::python {
namespace {

using PlacesById = std::map<std::string, Eigen::Vector3d>;

/// What an argument of this type is called in errors.
template <class T>
constexpr const char* kExpected = "a mapping from tag to position (3,) [m, world]";
template <>
constexpr const char* kExpected<double> = "a number";
template <>
constexpr const char* kExpected<bool> = "True or False";
template <>
constexpr const char* kExpected<std::string> = "text";
template <>
constexpr const char* kExpected<std::vector<double>> = "a list of numbers";
template <>
constexpr const char* kExpected<std::pair<double, double>> = "two numbers";
template <>
constexpr const char* kExpected<std::map<std::string, double>> = "a mapping from name to number";

/// What Python knows beforehand, as keywords; what it does not is None.
class Asked {
 public:
  Asked(py::dict keywords, std::string command)
      : keywords_(std::move(keywords)), command_(std::move(command)) {}

  template <class T>
  [[nodiscard]] std::optional<T> get(const char* key) const {
    if (!keywords_.contains(key) || keywords_[key].is_none()) return std::nullopt;
    try {
      return keywords_[key].cast<T>();
    } catch (const py::cast_error&) {
      refuse(key, kExpected<T>);
    }
  }
  [[noreturn]] void refuse(const char* key, const char* expected) const {
    throw Error(command_ + ": " + key + " is " + std::string(py::repr(keywords_[key])) +
                ", expected " + expected);
  }
  /// A list of finite numbers.
  [[nodiscard]] std::optional<std::vector<double>> list(const char* key) const {
    auto values = get<std::vector<double>>(key);
    const auto is_finite = [](double value) { return std::isfinite(value); };
    if (values && !std::all_of(values->begin(), values->end(), is_finite)) {
      refuse(key, "finite numbers");
    }
    return values;
  }
  /// Finite numbers by name.
  [[nodiscard]] std::optional<std::map<std::string, double>> numbers(const char* key) const {
    auto values = get<std::map<std::string, double>>(key);
    if (!values) return values;
    for (const auto& [name, value] : *values) {
      if (std::isfinite(value)) continue;
      throw Error(
          fmt::format("{}: {}: '{}' is {}, expected a finite number", command_, key, name, value));
    }
    return values;
  }
  [[nodiscard]] std::optional<double> number(const char* key, double least) const {
    const auto value = get<double>(key);
    if (value && !(*value >= least && std::abs(*value) <= 1e15)) {
      refuse(key, least == 0.0 ? "a finite number, 0 or more" : "a finite number");
    }
    return value;
  }

 private:
  py::dict keywords_;
  std::string command_;
};

constexpr double kAny = -1e15;

void take_heights(const Asked& asked, KnownBeforehand& known) {
  const auto of_all = asked.number("tag_height_m", kAny);
  const auto of_tag = asked.numbers("tag_heights_m");
  const auto side = asked.get<std::string>("vertical_side");
  if (!of_all && !of_tag && !side) return;
  if (of_all && side) throw Error("localize: tag_height_m and vertical_side exclude each other");
  known.heights = {};
  known.heights.of_all = of_all;
  if (of_tag) known.heights.of_tag = *of_tag;
  if (!side) return;
  if (*side != "above" && *side != "below") {
    throw Error("localize: vertical_side is '" + *side + "', expected 'above' or 'below'");
  }
  known.heights.estimated = *side == "above" ? HeightSide::kAbove : HeightSide::kBelow;
}

/// An offset for each antenna, or one for all of them.
void take_offsets(const Asked& asked, const std::vector<TagRead>& reads, KnownBeforehand& known) {
  const auto offsets = asked.numbers("offsets_rad");
  const auto of_all = asked.number("offset_rad", kAny);
  std::set<std::string> antennas;
  for (const TagRead& read : reads) antennas.insert(read.antenna);
  if (of_all) {
    for (const std::string& antenna : antennas) {
      known.offsets.push_back({antenna, std::nullopt, *of_all});
    }
  }
  if (!offsets) return;
  for (const auto& [antenna, offset] : *offsets) {
    if (antennas.count(antenna) == 0) {
      throw Error("localize: offsets_rad: there are no reads of antenna '" + antenna + "'" +
                  suggestion(antenna, {antennas.begin(), antennas.end()}));
    }
    known.offsets.push_back({antenna, std::nullopt, offset});
  }
}

void take_area(const Asked& asked, KnownBeforehand& known) {
  if (const auto side = asked.get<std::string>("side")) known.area.side = tag_side(*side);
  const auto box = asked.list("box_m");
  if (!box) return;
  if (box->size() != 4) throw Error("localize: box_m must be four numbers: x0, y0, x1, y1");
  const Eigen::Vector2d one((*box)[0], (*box)[1]);
  const Eigen::Vector2d other((*box)[2], (*box)[3]);
  known.area.box = Eigen::AlignedBox2d(one.cwiseMin(other), one.cwiseMax(other));
}

void take_pose_error(const Asked& asked, KnownBeforehand& known) {
  const auto sigma_m = asked.number("pose_sigma_m", 0.0);
  const auto yaw_sigma_deg = asked.number("pose_yaw_sigma_deg", 0.0);
  const auto time_constant_s = asked.number("pose_time_constant_s", 0.0);
  if (!sigma_m) {
    if (yaw_sigma_deg || time_constant_s) {
      throw Error("localize: pose_yaw_sigma_deg and pose_time_constant_s need pose_sigma_m");
    }
    return;
  }
  PoseErrorModel model;
  model.sigma_m = *sigma_m;
  model.yaw_sigma_rad = radians(yaw_sigma_deg.value_or(0.0));
  model.time_constant_s = time_constant_s.value_or(model.time_constant_s);
  known.pose_error = model;
}

/// Of a scenario, where there is one, with what is asked instead.
/// The scenario with the robot that was driven, if one is named.
Scenario as_driven(const Asked& asked, Scenario scenario) {
  const std::string robot = asked.get<std::string>("driven_robot").value_or("");
  if (robot.empty()) return scenario;
  const bool is_known = std::any_of(scenario.robots.begin(), scenario.robots.end(),
                                    [&](const RobotSpec& spec) { return spec.name == robot; });
  if (!is_known) asked.refuse("driven_robot", "the name of a robot of the scenario");
  Diagnostics unheard;  // The simulation has told.
  let_be_driven(robot, scenario, unheard);
  return scenario;
}

KnownBeforehand known_of(const Asked& asked, const LoadedPtr& loaded,
                         const std::vector<TagRead>& reads) {
  KnownBeforehand known;
  if (loaded) known = known_beforehand(as_driven(asked, loaded->parts.scenario));
  take_heights(asked, known);
  take_offsets(asked, reads, known);
  take_area(asked, known);
  take_pose_error(asked, known);
  known.world_sigma_m = asked.number("world_sigma_m", 0.0).value_or(kMeasuredWorldSigma_m);
  if (const auto references = asked.get<PlacesById>("reference_tags")) {
    known.reference_tags = *references;
  }
  known.limits.max_expected_error_m =
      asked.number("max_expected_error_m", 0.0).value_or(known.limits.max_expected_error_m);
  known.pi_ambiguity = asked.get<bool>("pi_ambiguity").has_value() ? asked.get<bool>("pi_ambiguity")
                                                                   : known.pi_ambiguity;
  return known;
}

/// Reads, poses and where tags truly were, out of their tables.
struct Tables {
  std::vector<TagRead> reads;
  std::vector<AntennaPose> poses;
  Truth truth;
};

struct ReadsArgument {
  Rows<ReadRow> rows;
  std::vector<std::string> readers, antennas, tags;
};
struct PosesArgument {
  Rows<PoseRow> rows;
  std::vector<std::string> names;
};
struct TruthArgument {
  Rows<TagRow> rows;
  std::vector<std::string> tags;
};

Tables tables_from(const ReadsArgument& reads, const PosesArgument& poses,
                   const TruthArgument& truth) {
  Tables tables;
  tables.reads = reads_from(reads.rows, reads.readers, reads.antennas, reads.tags);
  tables.poses = poses_from(poses.rows, poses.names);
  tables.truth.tag_positions = places_from(truth.rows, truth.tags);
  return tables;
}

struct Localized {
  LocalizationResult result;
  std::vector<TagOutcome> outcomes;
  std::string text;
  std::vector<std::string> warnings;
};

MethodSettings settings_of(const std::vector<std::pair<std::string, std::string>>& pairs) {
  MethodSettings settings;
  for (const auto& [key, value] : pairs) settings.push_back({key, value, {"settings", 0}});
  return settings;
}

Localized located(const Tables& tables, const LocalizationOptions& options, bool of_scenario) {
  Localized localized;
  Diagnostics diagnostics;
  if (!of_scenario) {
    warn_of_unknown_heights(options.known, overview_of(tables.reads).tags, diagnostics);
  }
  LocalizationResult& result = localized.result;
  result = locate_tags(tables.reads, tables.poses, options, diagnostics);
  localized.outcomes = judged(with_all_tags(result.estimates, tables.truth, {}), tables.reads,
                              tables.truth, options.known.reference_tags);
  Summary summary;
  summary.method = result.method;
  summary.seeds = {1};
  summary.tags = localized.outcomes;
  localized.text = table_of(summary);
  localized.warnings = diagnostics.warnings();
  return localized;
}

py::dict localize(const ReadsArgument& reads, const PosesArgument& poses,
                  const TruthArgument& truth, const std::string& method,
                  const std::optional<Method>& own,
                  const std::vector<std::pair<std::string, std::string>>& settings,
                  const LoadedPtr& loaded, const py::dict& keywords, int threads) {
  const Tables tables = tables_from(reads, poses, truth);
  LocalizationOptions options;
  if (loaded) options = localization_options(loaded->parts.scenario, threads);
  options.threads = threads;
  options.method = method;
  if (own) options.methods = {*own};
  const MethodSettings given = settings_of(settings);
  if (own || !given.empty()) options.settings = given;
  refuse_unused(given, {find_method(options.methods, method)}, options.methods);
  options.known = known_of(Asked(keywords, "localize"), loaded, tables.reads);
  Localized localized = interruptible(threads, py::none(), [&](const RunControl& control) {
    make_stoppable(control.stop, options.on_locating, options.known.trace);
    return located(tables, options, loaded != nullptr);
  });
  py::dict all = estimates_of(localized.outcomes);
  all["method"] = localized.result.method;
  all["why"] = localized.result.why;
  all["corrected_poses"] = tables_of({}, localized.result.corrected_poses)["poses"];
  all["text"] = localized.text;
  all["warnings"] = localized.warnings;
  return all;
}

TrackingSpec tracking_of(const Asked& asked, const LoadedPtr& loaded) {
  TrackingSpec spec;
  if (loaded) spec = loaded->parts.scenario.tracking;
  TrackingOptions& options = spec.options;
  if (const auto method = asked.get<std::string>("method")) options.method = track_method(*method);
  if (const auto lane = asked.list("lane")) {
    if (lane->size() != 3 && lane->size() != 4) {
      throw Error("track: lane must be x, y [m], heading [deg] and, if given, sigma [m]");
    }
    Lane of;
    of.point = {(*lane)[0], (*lane)[1]};
    of.heading_rad = radians((*lane)[2]);
    if (lane->size() == 4) of.lateral_sigma_m = (*lane)[3];
    options.lane = of;
  }
  if (const auto bidirectional = asked.get<bool>("bidirectional")) {
    if (!options.lane) throw Error("track: bidirectional can only be used with a lane");
    options.lane->bidirectional = *bidirectional;
  }
  if (const auto line = asked.list("line")) {
    if (line->size() != 3) throw Error("track: line must be x, y [m] and heading [deg]");
    spec.line = PassingLine{{(*line)[0], (*line)[1]}, radians((*line)[2])};
  }
  if (const auto speeds = asked.get<std::pair<double, double>>("speed_m_s")) {
    std::tie(options.min_speed_m_s, options.max_speed_m_s) = *speeds;
    if (!std::isfinite(speeds->first) || !std::isfinite(speeds->second)) {
      asked.refuse("speed_m_s", "two finite numbers");
    }
  }
  options.acceleration_noise =
      asked.number("acceleration_noise", 0.0).value_or(options.acceleration_noise);
  check(options);
  return spec;
}

py::dict to_python(const TrackingRun& run, const std::vector<std::string>& warnings) {
  Names tags;
  Names reasons;
  std::vector<TrackRow> tracks;
  std::vector<TrackPointRow> points;
  for (const TagTrack& tag : run.tracks) {
    const auto verdict = static_cast<std::int32_t>(tag.verdict);
    const std::int32_t of_tag = tags.number_of(tag.tag);
    const std::int32_t reason = reasons.number_of(tag.reason);
    const auto reads = static_cast<std::int64_t>(tag.reads);
    if (tag.tracks.empty()) {
      tracks.push_back({of_tag, verdict, reason, 0, reads, 0, kUnknown, kUnknown, kUnknown});
    }
    std::int32_t number = 0;
    for (const Track& track : tag.tracks) {
      tracks.push_back({of_tag, verdict, reason, ++number, reads,
                        static_cast<std::int64_t>(track.points.size()), track.rms_rad,
                        track.coherence, track.expected_error_m});
      for (const TrackPoint& point : track.points) {
        TrackPointRow row{};
        row.stamp_ns = point.stamp.time_since_epoch().count();
        row.tag = of_tag;
        row.number = number;
        std::copy_n(point.p_WT.data(), 3, row.position_m);
        std::copy_n(point.v_WT.data(), 3, row.velocity_m_s);
        std::copy_n(point.covariance.data(), 36, &row.covariance[0][0]);
        points.push_back(row);
      }
    }
  }
  Names places;
  std::vector<PassingRow> passings;
  for (const PassingOrder& order : run.orders) {
    for (const Passing& passing : order.passings) {
      passings.push_back({passing.stamp.time_since_epoch().count(), places.number_of(order.name),
                          tags.number_of(passing.tag), passing.sigma_s});
    }
  }
  const std::vector<std::string> verdicts = {to_string(TrackVerdict::kTracked),
                                             to_string(TrackVerdict::kAmbiguous),
                                             to_string(TrackVerdict::kNotTracked)};
  py::dict all;
  all["tracks"] = table(std::move(tracks),
                        {{"tag", tags.all()}, {"verdict", verdicts}, {"reason", reasons.all()}});
  all["points"] = table(std::move(points), {{"tag", tags.all()}});
  all["passings"] = table(std::move(passings), {{"place", places.all()}, {"tag", tags.all()}});
  all["warnings"] = warnings;
  return all;
}

py::dict track(const ReadsArgument& reads, const PosesArgument& poses, const LoadedPtr& loaded,
               const py::dict& keywords, int threads) {
  Tables tables = tables_from(reads, poses, {});
  const Asked asked(keywords, "track");
  const TrackingSpec spec = tracking_of(asked, loaded);
  const KnownBeforehand known = known_of(asked, loaded, tables.reads);
  TrackingRun run;
  run.reads = std::move(tables.reads);
  run.believed_poses = std::move(tables.poses);
  Diagnostics diagnostics;
  interruptible(threads, py::none(), [&](const RunControl& control) {
    tagfield::track(spec, known, control, run, diagnostics);
    return true;
  });
  return to_python(run, diagnostics.warnings());
}

py::object value_of(const CalibratedValue& value) {
  return py::make_tuple(value.value, value.sigma, value.observable);
}

py::dict to_python(const Calibration& calibration, const std::vector<std::string>& warnings) {
  py::dict antennas;
  for (const auto& [name, antenna] : calibration.antennas) {
    py::dict of;
    of["phase_sign"] = antenna.phase_sign;
    of["phase_centre_m"] =
        py::make_tuple(value_of(antenna.phase_centre_m[0]), value_of(antenna.phase_centre_m[1]),
                       value_of(antenna.phase_centre_m[2]));
    of["time_offset_s"] = value_of(antenna.time_offset_s);
    of["noise_rad"] = antenna.noise_rad;
    of["reads"] = antenna.reads;
    py::dict offsets;
    for (const ChannelOffset& offset : antenna.offsets) {
      offsets[py::float_(offset.frequency_hz)] = py::make_tuple(offset.value_rad, offset.sigma_rad);
    }
    of["offsets_rad"] = offsets;
    antennas[py::str(name)] = of;
  }
  py::dict all;
  all["antennas"] = antennas;
  all["pi_ambiguity"] = calibration.pi_ambiguity;
  all["yaml"] = to_yaml(calibration);
  all["warnings"] = warnings;
  return all;
}

py::dict calibrate(const ReadsArgument& reads, const PosesArgument& poses, const PlacesById& tags,
                   double phase_centre_sigma_m, double time_sigma_s, int threads) {
  const Tables tables = tables_from(reads, poses, {});
  CalibrationOptions options;
  options.phase_centre_sigma_m = phase_centre_sigma_m;
  options.time_offset_sigma_s = time_sigma_s;
  check(options);
  if (!has_phases(tables.reads)) {
    throw Error("calibrate: the reads have no phases, or all the same one");
  }
  Diagnostics diagnostics;
  Calibration calibration = interruptible(threads, py::none(), [&](const RunControl& /*control*/) {
    return tagfield::calibrate(tables.reads, tables.poses, tags, options, threads, diagnostics);
  });
  if (calibration.antennas.empty()) {
    throw Error(
        "calibrate: nothing to calibrate by: expected at least 30 reads of the tags by an antenna "
        "with poses whose phases follow their distances");
  }
  calibration.name = "calibration by Python";
  return to_python(calibration, diagnostics.warnings());
}

py::dict read(const std::string& reads, const std::string& poses, const std::string& format) {
  Diagnostics diagnostics;
  const auto tables = [&] {
    const py::gil_scoped_release unlocked;
    return tagfield::read_tables({"read", reads, poses, format}, diagnostics);
  }();
  py::dict all = tables_of(tables.reads, tables.poses);
  all["warnings"] = diagnostics.warnings();
  return all;
}

}  // namespace

void bind_reads(py::module_& module) {
  py::class_<ReadsArgument>(module, "ReadsArgument")
      .def(py::init([](Rows<ReadRow> rows, std::vector<std::string> readers,
                       std::vector<std::string> antennas, std::vector<std::string> tags) {
        return ReadsArgument{std::move(rows), std::move(readers), std::move(antennas),
                             std::move(tags)};
      }));
  py::class_<PosesArgument>(module, "PosesArgument")
      .def(py::init([](Rows<PoseRow> rows, std::vector<std::string> names) {
        return PosesArgument{std::move(rows), std::move(names)};
      }));
  py::class_<TruthArgument>(module, "TruthArgument")
      .def(py::init([](Rows<TagRow> rows, std::vector<std::string> tags) {
        return TruthArgument{std::move(rows), std::move(tags)};
      }));
  module.def("localize", &localize, py::arg("reads"), py::arg("poses"), py::arg("truth"),
             py::arg("method"), py::arg("own").none(true), py::arg("settings"),
             py::arg("loaded").none(true), py::arg("keywords"), py::arg("threads"));
  module.def("track", &track, py::arg("reads"), py::arg("poses"), py::arg("loaded").none(true),
             py::arg("keywords"), py::arg("threads"));
  module.def("calibrate", &calibrate, py::arg("reads"), py::arg("poses"), py::arg("tags"),
             py::arg("phase_centre_sigma_m"), py::arg("time_sigma_s"), py::arg("threads"));
  module.def("read", &read, py::arg("reads"), py::arg("poses"), py::arg("format"));
  module.def("read_dtype", [] { return py::dtype::of<ReadRow>(); });
  module.def("pose_dtype", [] { return py::dtype::of<PoseRow>(); });
  module.def("place_dtype", [] { return py::dtype::of<TagRow>(); });
  module.def("methods", [] {
    std::vector<std::pair<std::string, std::string>> methods;
    for (const Method& method : built_in_methods())
      methods.emplace_back(method.name, method.summary);
    return methods;
  });
}

}  // namespace tagfield::python
