// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/path_explanation.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// Weaker paths carry no power: a null of the pattern, or an impenetrable wall [dB].
constexpr double kLeast_db = -300.0;

std::vector<std::string> parts_of(const std::string& scoped) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = scoped.find("::"); end != std::string::npos;
       end = scoped.find("::", begin)) {
    parts.push_back(scoped.substr(begin, end - begin));
    begin = end + 2;
  }
  parts.push_back(scoped.substr(begin));
  return parts;
}

/// Whether a name is generic, with or without a trailing number.
bool is_generic(const std::string& name) {
  const std::string word = name.substr(0, name.find_last_not_of("0123456789_") + 1);
  constexpr const char* kWords[] = {"link",   "base_link", "base", "body",     "box",
                                    "visual", "collision", "mesh", "geometry", ""};
  return std::any_of(std::begin(kWords), std::end(kWords),
                     [&](const char* known) { return word == known; });
}

SurfaceOnPath surface(const RadioWorld& world, std::uint32_t solid, double gain_db) {
  SurfaceOnPath met;
  met.solid = world.solids[solid];
  met.object = object_of(met.solid);
  met.material = world.materials[world.material_of[solid]].name;
  met.gain_db = gain_db;
  met.opaque = world.scene.is_opaque(solid);
  return met;
}

std::vector<SurfaceOnPath> bounces_of(const RadioPath& path, const PathBudget& budget,
                                      const RadioWorld& world) {
  std::vector<SurfaceOnPath> met;
  for (std::size_t i = 0; i < static_cast<std::size_t>(path.bounce_count); ++i) {
    met.push_back(surface(world, path.bounces[i].solid, budget.bounce_db[i]));
    met.back().p_W = path.bounces[i].p_W;
  }
  return met;
}

struct Ends {
  RadioEnd antenna;
  RadioEnd tag;
  ChannelEffects effects;
};

Ends ends_of(const RadioView& view, const TagEnd& tag) {
  return {{view.model.antenna, view.X_WA},
          {tag.model.antenna, tag.X_WT},
          {view.model.effects.patterns, view.model.effects.polarization}};
}

void set_relative(std::complex<double> gain, std::complex<double> free_gain,
                  PathExplanation& explanation) {
  if (!(std::norm(free_gain) > 0.0)) return;
  const std::complex<double> ratio = gain / free_gain;
  const double relative_db = to_db(std::norm(ratio));
  if (!std::isfinite(relative_db) || relative_db <= kLeast_db) return;
  explanation.relative_db = relative_db;
  explanation.relative_phase_rad = wrap_to_pi(std::arg(ratio));
}

/// The gain of an edge is relative to a free path of the same length.
PathExplanation explain(const RadioView& view, const TagEnd& tag, const DiffractedPath& path,
                        double direct_m, std::complex<double> free_gain) {
  const std::complex<double> gain = gain_of(path, view, tag);
  const Ends ends = ends_of(view, tag);
  const auto power_at = [&](const RadioEnd& end, const Eigen::Vector3d& u_W) {
    if (!ends.effects.patterns) return peak_gain(end.pattern);
    return tagfield::gain(end.pattern, end.X_WA.rotation.conjugate() * u_W);
  };
  const double free = view.carrier.lambda_m / (4.0 * kPi * path.length_m());
  const double both =
      power_at(ends.antenna, path.departure_W) * power_at(ends.tag, -path.arrival_W);
  PathExplanation explanation;
  explanation.length_m = path.length_m();
  explanation.excess_m = std::max(0.0, path.length_m() - direct_m);
  explanation.edge = surface(view.world, (*view.edges)[path.edge].solid,
                             to_db(std::norm(gain)) - to_db(both * free * free));
  explanation.edge->p_W = path.p_W;
  set_relative(gain, free_gain, explanation);
  return explanation;
}

PathExplanation explain(const RadioView& view, const TagEnd& tag, const Ends& ends,
                        const RadioPath& path, double direct_m, std::complex<double> free_gain) {
  const PathBudget budget =
      path_budget(path, ends.antenna, ends.tag, view.world, view.carrier, ends.effects);
  PathExplanation explanation;
  explanation.order = path.bounce_count;
  explanation.length_m = path.length_m;
  explanation.excess_m = std::max(0.0, path.length_m - direct_m);
  explanation.blocked = path.blocked;
  explanation.bounces = bounces_of(path, budget, view.world);
  explanation.crossings = crossings_of(path, budget, view.world);
  if (path.blocked) return explanation;
  std::complex<double> gain =
      path_gain(path, ends.antenna, ends.tag, view.world, view.carrier, ends.effects);
  if (!view.bodies.empty()) {
    const std::complex<double> left = past_bodies(path, view, tag);
    explanation.bodies_db = to_db(std::norm(left));
    gain *= left;
  }
  set_relative(gain, free_gain, explanation);
  return explanation;
}

double strength(const PathExplanation& path) { return path.relative_db.value_or(kLeast_db); }

}  // namespace

std::string object_of(const std::string& solid) {
  const std::vector<std::string> parts = parts_of(solid);
  if (parts.size() < 3) return solid;
  const std::string& link = parts[parts.size() - 2];
  const std::string& collision = parts.back();
  if (!is_generic(link)) return link;
  return is_generic(collision) ? parts.front() : collision;
}

std::vector<RadioPath> paths_of(const RadioView& view, const TagEnd& tag, bool receiver) {
  TraceOptions tracing = view.tracing;
  tracing.keep_blocked = true;
  std::vector<RadioPath> paths;
  const ImageSet& images = receiver ? *view.receiver_images : *view.images;
  trace_paths(view.world.scene, images, tag.X_WT.translation, tracing, paths);
  return paths;
}

RadioPath unhindered(const RadioPath& path) {
  RadioPath open = path;
  open.crossings.clear();
  open.blocked = false;
  return open;
}

std::vector<SurfaceOnPath> crossings_of(const RadioPath& path, const PathBudget& budget,
                                        const RadioWorld& world) {
  std::vector<SurfaceOnPath> met;
  for (std::size_t i = 0; i < path.crossings.size(); ++i) {
    const Crossing& through = path.crossings[i];
    met.push_back(surface(world, through.solid, budget.crossing_db[i]));
    met.back().p_W = through.p_W;
    met.back().thickness_m = through.length_m;
  }
  return met;
}

std::vector<PathExplanation> explain_paths(const RadioView& view, const TagEnd& tag,
                                           const std::vector<RadioPath>& paths,
                                           const std::vector<DiffractedPath>& over_edges) {
  const Ends ends = ends_of(view, tag);
  const double direct_m = (tag.X_WT.translation - view.X_WA.translation).norm();
  const std::complex<double> free_gain =
      free_space_gain(ends.antenna, ends.tag, view.carrier, ends.effects);
  std::vector<PathExplanation> explanations;
  explanations.reserve(paths.size());
  for (const RadioPath& path : paths) {
    explanations.push_back(explain(view, tag, ends, path, direct_m, free_gain));
  }
  const auto direct_ones = static_cast<std::ptrdiff_t>(
      std::count_if(explanations.begin(), explanations.end(),
                    [](const PathExplanation& path) { return path.order == 0; }));
  for (const DiffractedPath& path : over_edges) {
    explanations.push_back(explain(view, tag, path, direct_m, free_gain));
  }
  const auto rest = explanations.begin() + direct_ones;
  std::stable_sort(rest, explanations.end(),
                   [](const PathExplanation& a, const PathExplanation& b) {
                     return a.blocked != b.blocked ? b.blocked : strength(a) > strength(b);
                   });
  return explanations;
}

}  // namespace tagfield
