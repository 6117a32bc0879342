// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/internal/link_budget_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// Least effect of a moving body on a path to be reported [dB].
constexpr double kNoticed_db = 0.05;

void add(std::vector<BudgetLine>& lines, const std::string& what, double db) {
  BudgetLine& line = lines.emplace_back();
  line.what = what;
  line.db = db;
}

std::string through(const SurfaceOnPath& met) {
  if (met.thickness_m > 0.0) {
    return fmt::format("through {} ({}, {:.2f} m)", met.object, met.material, met.thickness_m);
  }
  return fmt::format("through {} ({}, a sheet)", met.object, met.material);
}

std::string blockers(const std::vector<SurfaceOnPath>& between) {
  const auto wall = std::find_if(between.begin(), between.end(),
                                 [](const SurfaceOnPath& met) { return met.opaque; });
  return wall == between.end() ? "something" : fmt::format("{} ({})", wall->object, wall->material);
}

/// Adds the lines of the direct path, as if nothing opaque obstructed it.
void add_direct(const RadioView& view, const TagEnd& tag, bool receiver, const RadioPath& direct,
                OneWayLink& way) {
  const RadioEnd antenna{view.model.antenna, receiver ? view.X_WR : view.X_WA};
  const RadioEnd at_tag{tag.model.antenna, tag.X_WT};
  const ChannelEffects effects{view.model.effects.patterns, view.model.effects.polarization};
  const auto budget_of = [&](const RadioPath& path) {
    return path_budget(path, antenna, at_tag, view.world, view.carrier, effects);
  };
  way.between = crossings_of(direct, budget_of(direct), view.world);
  way.blocked = direct.blocked;
  const PathBudget budget = budget_of(direct.blocked ? unhindered(direct) : direct);
  add(way.lines, "antenna gain towards the tag", budget.antenna_db);
  add(way.lines, fmt::format("free space over {:.2f} m", direct.length_m), budget.spreading_db);
  for (const SurfaceOnPath& met : way.between) {
    if (!direct.blocked) add(way.lines, through(met), met.gain_db);
  }
  for (const MovingBody& body : view.bodies) {
    const double db = to_db(
        std::norm(past_body(body, antenna.X_WA.translation, tag.X_WT.translation, view.carrier)));
    if (direct.blocked || std::abs(db) < kNoticed_db) continue;
    add(way.lines, fmt::format("past {} ({})", body.name, body.material.name), db);
  }
  add(way.lines, "polarization", budget.polarization_db);
  add(way.lines, "tag gain towards the antenna", budget.tag_db);
}

/// Powers and gains below this are nothing: of a pattern's null, or where no path is left.
constexpr double kLeast_db = -250.0;

bool is_nothing(double db) { return db < kLeast_db; }

/// Whether the direct path carries nothing even if nothing obstructs it, as to a tag seen end-on.
bool has_null(const std::vector<BudgetLine>& lines) {
  return std::any_of(lines.begin(), lines.end(),
                     [](const BudgetLine& line) { return is_nothing(line.db); });
}

/// The sum of the lines that are something.
double sum_without_nulls(const std::vector<BudgetLine>& lines) {
  double sum = 0.0;
  for (const BudgetLine& line : lines) sum += is_nothing(line.db) ? 0.0 : line.db;
  return sum;
}

std::string others_line(const OneWayLink& way, std::size_t count) {
  if (way.blocked && count == 0) return blockers(way.between) + " blocks the only path";
  const std::string others = count == 1 ? "1 other path" : fmt::format("{} other paths", count);
  if (way.blocked) {
    return fmt::format("{} blocks the direct path; {} instead", blockers(way.between), others);
  }
  if (has_null(way.lines)) return fmt::format("{} instead", others);
  return count == 0 ? "what remains of it" : fmt::format("{} with it", others);
}

std::size_t count_others(const OneWayLink& way) {
  const auto bounced = std::count_if(way.paths.begin(), way.paths.end(), [](const RadioPath& path) {
    return path.bounce_count > 0 && !path.blocked;
  });
  return static_cast<std::size_t>(bounced) + way.over_edges.size();
}

/// All materials that the paths meet, sorted by name.
std::vector<MaterialOnLink> materials_on(const std::vector<PathExplanation>& paths,
                                         const RadioWorld& world, double frequency_hz) {
  std::set<std::string> met;
  for (const PathExplanation& path : paths) {
    for (const SurfaceOnPath& at : path.bounces) met.insert(at.material);
    for (const SurfaceOnPath& at : path.crossings) met.insert(at.material);
    if (path.edge) met.insert(path.edge->material);
  }
  std::vector<MaterialOnLink> all;
  for (const std::string& name : met) {
    const Material& material = find_material(world.materials, name);
    all.push_back({name, permittivity(material, frequency_hz).real(),
                   conductivity(material, frequency_hz), material.min_ghz, material.max_ghz,
                   is_measured_at(material, frequency_hz)});
  }
  return all;
}

double paths_db(const RadioView& view, const TagEnd& tag, bool receiver, const OneWayLink& way) {
  const RadioEnd antenna{view.model.antenna, receiver ? view.X_WR : view.X_WA};
  const RadioEnd at_tag{tag.model.antenna, tag.X_WT};
  std::complex<double> sum = 0.0;
  for (const RadioPath& path : way.paths) {
    if (path.blocked) continue;
    sum += past_bodies(path, view, tag, receiver) *
           path_gain(path, antenna, at_tag, view.world, view.carrier,
                     {view.model.effects.patterns, view.model.effects.polarization});
  }
  for (const DiffractedPath& path : way.over_edges) sum += gain_of(path, view, tag, receiver);
  return to_db(std::norm(sum));
}

/// The link of the tag alone, as in the lines before "coupling".
RadioLink link_alone(const RadioView& view, const TagEnd& tag, const RadioLink& of_link) {
  if (tag.around == nullptr) return of_link;
  TagEnd alone = tag;
  alone.around = nullptr;
  std::vector<RadioPath> paths;
  return link_of(view, alone, paths);
}

void add_coupling(const TagEnd& tag, std::complex<double> coupled, std::complex<double> alone,
                  std::vector<BudgetLine>& lines) {
  if (tag.around == nullptr) return;
  const std::size_t count = tag.around->neighbours.size();
  add(lines, fmt::format("coupling with {} tag{} nearby", count, count == 1 ? "" : "s"),
      to_db(std::norm(coupled)) - to_db(std::norm(alone)));
}

}  // namespace

OneWayLink one_way(const RadioView& view, const TagEnd& tag, double gain_db, bool receiver) {
  OneWayLink way;
  way.paths = paths_of(view, tag, receiver);
  way.over_edges = diffracted_paths(view, tag, receiver);
  if (way.paths.empty()) {
    add(way.lines, "both ends are at one position", gain_db);
    return way;
  }
  add_direct(view, tag, receiver, way.paths.front(), way);
  const bool is_diffuse = view.model.effects.diffuse && view.model.diffuse_k_db.has_value();
  const double singles_db = is_diffuse ? paths_db(view, tag, receiver, way) : gain_db;
  // What is nothing can't be compared with: other paths are then relative to the other lines.
  const double others_db = singles_db - sum_without_nulls(way.lines);
  const std::size_t count = count_others(way);
  const bool is_null = has_null(way.lines) && is_nothing(singles_db);
  // Without other paths, a difference is due to rounding.
  if (!is_null && (count > 0 || way.blocked || std::abs(others_db) > 1e-6)) {
    add(way.lines, others_line(way, count), others_db);
  }
  if (is_diffuse) add(way.lines, "diffuse waves", gain_db - singles_db);
  return way;
}

void add_budget(const RadioView& view, const TagEnd& tag, const RadioLink& of_link,
                PhysicalLink& link) {
  const RadioModel& model = view.model;
  const RadioLink alone = link_alone(view, tag, of_link);
  OneWayLink there = one_way(view, tag, to_db(std::norm(alone.forward)), false);
  add(link.to_tag, "transmit power", model.transmit_power_dbm);
  add(link.to_tag, "cable", -model.cable_loss_db);
  link.to_tag.insert(link.to_tag.end(), there.lines.begin(), there.lines.end());
  add_coupling(tag, of_link.forward, alone.forward, link.to_tag);
  add(link.to_tag, "detuning of the tag", -tag.model.detuning_db);
  link.paths = explain_paths(view, tag, there.paths, there.over_edges);
  link.materials = materials_on(link.paths, view.world, link.frequency_hz);
  link.between = std::move(there.between);

  add(link.to_reader, "power at the chip", link.tag_dbm);
  add(link.to_reader, "modulation", tag.model.modulation_db);
  add(link.to_reader, "detuning of the tag", -tag.model.detuning_db);
  const double back_db = to_db(std::norm(of_link.backward));
  if (model.X_AR) {
    OneWayLink back = one_way(view, tag, to_db(std::norm(alone.backward)), true);
    link.to_reader.insert(link.to_reader.end(), back.lines.begin(), back.lines.end());
    add_coupling(tag, of_link.backward, alone.backward, link.to_reader);
    link.between_return = std::move(back.between);
  } else {
    add(link.to_reader, "the same path back", back_db);
  }
  add(link.to_reader, "cable", -model.cable_loss_db);
}

}  // namespace tagfield
