// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/link_matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>

#include "tagfield/base/parallel.h"
#include "tagfield/base/random.h"
#include "tagfield/layout/internal/link_store.h"
#include "tagfield/planning/local_link.h"

namespace tagfield {
namespace {

constexpr double kStop_m = 0.5;
constexpr double kMaxBytes = 4e9;

std::vector<LinkRow> rows_of(const PlanSpec& plan) {
  std::vector<LinkRow> rows;
  for (std::size_t group = 0; group < plan.tags.size(); ++group) {
    const PlanTags& tags = plan.tags[group];
    const std::vector<PlanStop> stops = stops_of(tags, plan.dwell_s);
    for (std::size_t place = 0; place < tags.places.size(); ++place) {
      for (std::size_t turn = 0; turn < tags.orientations.size(); ++turn) {
        for (std::size_t stop = 0; stop < stops.size(); ++stop) {
          const Eigen::Vector3d p_W = stops[stop].p_W + tags.places[place];
          rows.push_back({group, place, turn, stop, {tags.orientations[turn], p_W}});
        }
      }
    }
  }
  return rows;
}

std::vector<LinkColumn> columns_of(const PlanSpec& plan) {
  std::vector<LinkColumn> columns;
  for (std::size_t mount = 0; mount < plan.mounts.size(); ++mount) {
    for (std::size_t look = 0; look < plan.mounts[mount].X_WA.size(); ++look) {
      columns.push_back({mount, look});
    }
  }
  return columns;
}

void append(std::string& text, const RigidTransform& X) {
  text += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g};", X.translation.x(),
                      X.translation.y(), X.translation.z(), X.rotation.w(), X.rotation.x(),
                      X.rotation.y(), X.rotation.z());
}

struct ShapeText {
  std::string operator()(const Box& box) const {
    return fmt::format("box {:.17g} {:.17g} {:.17g}", box.size.x(), box.size.y(), box.size.z());
  }
  std::string operator()(const Cylinder& cylinder) const {
    return fmt::format("cylinder {:.17g} {:.17g}", cylinder.radius, cylinder.length);
  }
  std::string operator()(const Sphere& sphere) const {
    return fmt::format("sphere {:.17g}", sphere.radius);
  }
  std::string operator()(const Plane& plane) const {
    return fmt::format("plane {:.17g} {:.17g} {:.17g}", plane.normal.x(), plane.normal.y(),
                       plane.normal.z());
  }
  std::string operator()(const MeshPtr& mesh) const {
    std::string text = "mesh";
    for (const Eigen::Vector3d& p : mesh->vertices) {
      text += fmt::format(" {:.17g} {:.17g} {:.17g}", p.x(), p.y(), p.z());
    }
    for (const auto& corners : mesh->triangles) {
      text += fmt::format(" {} {} {}", corners[0], corners[1], corners[2]);
    }
    return text;
  }
};

/// Everything about the world that affects waves.
std::string text_of(const Material& material) {
  return fmt::format("{} {:.17g} {:.17g} {:.17g} {:.17g} {} {} {};", material.name,
                     material.permittivity_a, material.permittivity_b, material.conductivity_c,
                     material.conductivity_d, material.wall_m.value_or(-1.0),
                     material.crossing_db.value_or(-1.0), material.is_opaque);
}

std::string text_of(const ScenarioWithWorld& loaded) {
  const RadioWorld& world = *loaded.scenario.radio_world;
  std::string text;
  for (std::size_t i = 0; i < loaded.scene.collisions.size(); ++i) {
    const Collision& collision = loaded.scene.collisions[i];
    text += std::visit(ShapeText{}, collision.shape) + ' ';
    append(text, collision.X_WC);
    text += text_of(world.materials[world.material_of[i]]);
  }
  return text + fmt::format("{:.17g}", loaded.scenario.materials.min_facet_m2);
}

std::string text_of(const std::vector<RawParameter>& settings) {
  std::string text;
  for (const RawParameter& setting : settings) text += setting.key + '=' + setting.value + ';';
  return text;
}

std::string text_of(const std::vector<MovingBody>& bodies) {
  std::string text;
  for (const MovingBody& body : bodies) {
    text += fmt::format("body {} {:.17g};", body.is_round, body.yaw_rad) + text_of(body.material);
    for (const Eigen::Vector3d& row : {body.p_W, body.half_m}) {
      text += fmt::format("{:.17g} {:.17g} {:.17g};", row.x(), row.y(), row.z());
    }
  }
  return text;
}

/// Everything that determines the rows.
std::string text_of(const PlanSpec& plan, const std::vector<LinkRow>& rows) {
  std::string text;
  for (const PlanTags& tags : plan.tags) text += tags.name + ' ' + text_of(tags.model->settings);
  for (const LinkRow& row : rows) {
    text += fmt::format("{} ", row.group);
    append(text, row.X_WT);
  }
  return text;
}

/// Key of the draw of diffuse waves at a row.
std::uint64_t key_of(const PlanSpec& plan, const LinkRow& row) {
  return stream_key(
      fmt::format("{} {} {} {}", plan.tags[row.group].name, row.place, row.orientation, row.stop));
}

void require_open_air(const RadioScene& scene, const std::vector<PlanMount>& mounts) {
  std::size_t inside = 0;
  const PlanMount* first = nullptr;
  for (const PlanMount& mount : mounts) {
    const std::vector<char> around = shells_around(scene, mount.X_WA.front().translation);
    if (std::all_of(around.begin(), around.end(), [](char shell) { return shell == 0; })) continue;
    ++inside;
    if (first == nullptr) first = &mount;
  }
  if (first == nullptr) return;
  const Eigen::Vector3d& p = first->X_WA.front().translation;
  const std::string others =
      inside > 1 ? fmt::format(" and {} more mounts are", inside - 1) : " is";
  fail(first->location,
       fmt::format("mount '{}' at ({:g}, {:g}, {:g}) m{} inside a solid of the world: move it, or "
                   "list the solid in plan.forbidden",
                   first->name, p.x(), p.y(), p.z(), others));
}

class Evaluation {
 public:
  Evaluation(const ScenarioToPlan& to_plan, const LinkMatrixRequest& request, LinkMatrix& matrix)
      : to_plan_(to_plan), request_(request), matrix_(matrix) {
    if (request.folder.empty()) return;
    std::filesystem::create_directories(request.folder);
    common_ = text_of(to_plan.loaded) + text_of(to_plan.plan, matrix.rows) +
              text_of(request.bodies) + fmt::format("{}", request.seed);
    common_ = content_hash(common_);
  }

  void column(std::size_t number, LinkMatrixCounts& counts) {
    const LinkColumn& column = matrix_.columns[number];
    const PlanMount& mount = to_plan_.plan.mounts[column.mount];
    const RadioModel& model = *physical(mount.antenna);
    const std::vector<double> carriers = sampled_carriers(model);
    std::vector<std::int8_t>& steps = matrix_.steps[number];
    const std::size_t size = matrix_.rows.size() * kFadingPositions * carriers.size();
    std::string hash;
    if (!request_.folder.empty()) {
      std::string text =
          common_ + text_of(model.settings) + fmt::format("{:.17g} ", model.transmit_power_dbm);
      append(text, mount.X_WA[column.look]);
      hash = content_hash(text);
      bool damaged = false;
      auto stored = stored_column(request_.folder, hash, size, damaged);
      const std::lock_guard lock(mutex_);
      if (damaged) ++counts.damaged;
      if (stored) {
        ++counts.kept;
        steps = std::move(*stored);
        return;
      }
    }
    compute(mount, column.look, model, carriers, steps);
    if (!request_.folder.empty() && !stopped()) store_column(request_.folder, hash, steps);
  }

  [[nodiscard]] bool stopped() const { return request_.stop != nullptr && *request_.stop; }

 private:
  void compute(const PlanMount& mount, std::size_t look, const RadioModel& model,
               const std::vector<double>& carriers, std::vector<std::int8_t>& steps) const {
    const Scenario& scenario = to_plan_.loaded.scenario;
    const double middle_hz = carriers[carriers.size() / 2];
    RadioView view = view_from(model, *scenario.radio_world, mount.X_WA[look], middle_hz,
                               stream_key(mount.name), request_.seed);
    if (model.effects.bodies) view.bodies = request_.bodies;
    const std::size_t states = kFadingPositions * carriers.size();
    steps.assign(matrix_.rows.size() * states, -128);
    std::vector<RadioPath> paths;
    for (std::size_t row = 0; row < matrix_.rows.size() && !stopped(); ++row) {
      const LinkRow& of_row = matrix_.rows[row];
      const TagEnd tag{*to_plan_.plan.tags[of_row.group].model, of_row.X_WT,
                       key_of(to_plan_.plan, of_row)};
      const LinkStates link(fading_margins_db(view, tag, carriers, 0, paths));
      std::copy(link.steps().begin(), link.steps().end(),
                steps.begin() + static_cast<std::ptrdiff_t>(row * states));
    }
  }

  const ScenarioToPlan& to_plan_;
  const LinkMatrixRequest& request_;
  LinkMatrix& matrix_;
  std::string common_;
  std::mutex mutex_;
};

}  // namespace

std::vector<PlanStop> stops_of(const PlanTags& tags, double dwell_s) {
  if (tags.path.empty()) return {{0.0, dwell_s, Eigen::Vector3d::Zero()}};
  if (tags.path.size() == 1) {
    return {{0.0, dwell_s, tags.path.front().X_WB.translation}};
  }
  std::vector<PlanStop> stops;
  for (std::size_t i = 0; i + 1 < tags.path.size(); ++i) {
    const Eigen::Vector3d from = tags.path[i].X_WB.translation;
    const Eigen::Vector3d way = tags.path[i + 1].X_WB.translation - from;
    const double begin_s = to_seconds(tags.path[i].stamp);
    const double long_s = to_seconds(tags.path[i + 1].stamp) - begin_s;
    const double pieces = std::max(1.0, std::ceil(way.norm() / kStop_m - 1e-9));
    for (double piece = 0.0; piece < pieces; piece += 1.0) {
      stops.push_back({begin_s + long_s * piece / pieces, begin_s + long_s * (piece + 1.0) / pieces,
                       from + way * ((piece + 0.5) / pieces)});
    }
  }
  return stops;
}

LinkStates LinkMatrix::states(std::size_t column, std::size_t row) const {
  const std::size_t count = kFadingPositions * carriers[column];
  const auto begin = steps[column].begin() + static_cast<std::ptrdiff_t>(row * count);
  std::vector<std::int8_t> of_link(begin, begin + static_cast<std::ptrdiff_t>(count));
  const bool is_empty =
      std::all_of(of_link.begin(), of_link.end(), [](std::int8_t step) { return step == -128; });
  return is_empty ? LinkStates() : LinkStates(std::move(of_link));
}

std::vector<LinkElement> elements_of(const LinkMatrix& matrix) {
  std::vector<LinkElement> elements;
  for (std::size_t row = 0; row < matrix.rows.size(); ++row) {
    if (matrix.rows[row].stop == 0) {
      elements.push_back({row, 1});
    } else {
      ++elements.back().stops;
    }
  }
  return elements;
}

LinkMatrix evaluate_links(const ScenarioToPlan& to_plan, const LinkMatrixRequest& request,
                          LinkMatrixCounts& counts) {
  require_open_air(to_plan.loaded.scenario.radio_world->scene, to_plan.plan.mounts);
  LinkMatrix matrix;
  matrix.rows = rows_of(to_plan.plan);
  matrix.columns = columns_of(to_plan.plan);
  double bytes = 0.0;
  for (const LinkColumn& column : matrix.columns) {
    const RadioModel& model = *physical(to_plan.plan.mounts[column.mount].antenna);
    matrix.carriers.push_back(sampled_carriers(model).size());
    bytes += static_cast<double>(matrix.rows.size() * kFadingPositions * matrix.carriers.back());
  }
  if (bytes > kMaxBytes) {
    throw Error(fmt::format(
        "plan: {} ways to mount an antenna and {} tag positions and orientations make a matrix of "
        "{:.1f} GB, over {:g}: expected fewer, by a greater spacing_m or fewer orientations",
        matrix.columns.size(), matrix.rows.size(), 1e-9 * bytes, 1e-9 * kMaxBytes));
  }
  counts.columns = matrix.columns.size();
  matrix.steps.resize(matrix.columns.size());
  Evaluation evaluation(to_plan, request, matrix);
  std::mutex mutex;
  std::size_t done = 0;
  parallel_for(matrix.columns.size(), request.threads, [&](std::size_t column) {
    if (evaluation.stopped()) return;
    evaluation.column(column, counts);
    const std::lock_guard lock(mutex);
    ++done;
    if (request.on_progress) {
      request.on_progress(static_cast<double>(done) / static_cast<double>(matrix.columns.size()));
    }
  });
  if (evaluation.stopped()) {
    throw Error(request.folder.empty()
                    ? "plan: interrupted"
                    : "plan: interrupted; what is computed is kept, the same command resumes");
  }
  return matrix;
}

}  // namespace tagfield
