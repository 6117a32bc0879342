// SPDX-License-Identifier: Apache-2.0
#include "tagfield/tracking/internal/line_search.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kShortest = 0.3;        ///< First sub-apertures [s].
constexpr std::size_t kMaxLookups = 40;  ///< Maximum number of sub-apertures for scoring the grid.
constexpr std::size_t kFewestInAperture = 3;
constexpr std::size_t kCoarseHypotheses = 40;
constexpr double kSpeedStep = 0.15;  ///< [m/s]
constexpr double kHeadingStep = radians(10.0);
constexpr double kPlaceStep = 0.25;  ///< [m]
constexpr double kLaneStep = 0.12;   ///< Along a lane [m].
/// Minimum coherence over longer sub-apertures, relative to the shortest.
constexpr double kStaysCoherent = 0.85;
constexpr double kFlat = 0.03;  ///< Antennas within this of a plane (rms) lie in it [m].

/// Coherent sum of one sub-aperture for each range rate.
struct RateTable {
  double t_s = 0.0;
  Eigen::Vector3d p_WA;
  Eigen::Vector3d v_WA;
  double min_rate = 0.0;
  double step = 1.0;
  std::vector<float> power;
};

struct Grid {
  std::vector<Eigen::Vector3d> places;
  std::vector<Eigen::Vector3d> velocities;
};

struct Scored {
  StraightMotion motion;
  double score = 0.0;
};

RateTable table_of(const Pass& pass, const SubAperture& aperture, double max_rate) {
  RateTable table;
  for (const std::size_t i : aperture) {
    table.t_s += pass.reads[i].t_s / static_cast<double>(aperture.size());
  }
  const PassRead& middle = pass.reads[aperture[aperture.size() / 2]];
  table.p_WA = middle.p_WA;
  table.v_WA = middle.v_WA;
  // An eighth of the lobe's width, so that interpolation between two rows loses little.
  table.step = kTwoPi / (middle.k * kShortest) / 8.0;
  table.min_rate = -max_rate;
  const auto rows = static_cast<std::size_t>(2.0 * max_rate / table.step) + 2;
  for (std::size_t row = 0; row < rows; ++row) {
    const double rate = table.min_rate + static_cast<double>(row) * table.step;
    std::complex<double> sum;
    for (const std::size_t i : aperture) {
      const PassRead& read = pass.reads[i];
      sum += std::polar(1.0, read.phase_rad - read.k * rate * (read.t_s - table.t_s));
    }
    table.power.push_back(static_cast<float>(std::abs(sum)));
  }
  return table;
}

double look_up(const RateTable& table, double rate) {
  const double place = (rate - table.min_rate) / table.step;
  if (!(place >= 0.0)) return 0.0;
  const auto row = static_cast<std::size_t>(place);
  if (row + 1 >= table.power.size()) return 0.0;
  const double part = place - static_cast<double>(row);
  return (1.0 - part) * static_cast<double>(table.power[row]) +
         part * static_cast<double>(table.power[row + 1]);
}

/// Tables of sub-apertures, evenly thinned to limit the work for the grid.
std::vector<RateTable> rate_tables(const Pass& pass, const TrackingOptions& options) {
  std::vector<SubAperture> apertures = sub_apertures(pass, kShortest);
  apertures.erase(
      std::remove_if(apertures.begin(), apertures.end(),
                     [](const SubAperture& one) { return one.size() < kFewestInAperture; }),
      apertures.end());
  double fastest_antenna = 0.0;
  for (const PassRead& read : pass.reads) {
    fastest_antenna = std::max(fastest_antenna, read.v_WA.norm());
  }
  const double max_rate = 1.1 * (options.max_speed_m_s + fastest_antenna);
  const std::size_t count = std::min(apertures.size(), kMaxLookups);
  std::vector<RateTable> tables;
  for (std::size_t i = 0; i < count; ++i) {
    tables.push_back(table_of(pass, apertures[i * apertures.size() / count], max_rate));
  }
  return tables;
}

double score_of(const std::vector<RateTable>& tables, const Eigen::Vector3d& place,
                const Eigen::Vector3d& velocity) {
  double score = 0.0;
  for (const RateTable& table : tables) {
    const Eigen::Vector3d away = place + table.t_s * velocity - table.p_WA;
    const double r = away.norm();
    if (r < 1e-6) continue;
    score += look_up(table, away.dot(velocity - table.v_WA) / r);
  }
  return score;
}

std::vector<double> steps(double least, double most, double step) {
  std::vector<double> values;
  const int count = std::max(1, static_cast<int>(std::ceil((most - least) / step)) + 1);
  values.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    values.push_back(count == 1 ? 0.5 * (least + most)
                                : least + (most - least) * i / (count - 1.0));
  }
  return values;
}

Eigen::Vector3d level(double x, double y, double z) { return {x, y, z}; }

Grid lane_grid(const Pass& pass, const TrackingOptions& options, const Lane& lane) {
  Grid grid;
  const Eigen::Vector2d along(std::cos(lane.heading_rad), std::sin(lane.heading_rad));
  const Eigen::Vector2d side(-along.y(), along.x());
  const double middle = along.dot(middle_of_antennas(pass).head<2>() - lane.point);
  const double width = std::min(2.0 * lane.lateral_sigma_m, options.reach_m);
  for (const double s : steps(middle - options.reach_m, middle + options.reach_m, kLaneStep)) {
    for (const double d : steps(-width, width, kPlaceStep)) {
      const Eigen::Vector2d place = lane.point + s * along + d * side;
      grid.places.push_back(level(place.x(), place.y(), pass.height.mean_m));
    }
  }
  for (const double v : steps(options.min_speed_m_s, options.max_speed_m_s, 0.5 * kSpeedStep)) {
    grid.velocities.push_back(level(v * along.x(), v * along.y(), 0.0));
    if (lane.bidirectional) grid.velocities.push_back(level(-v * along.x(), -v * along.y(), 0.0));
  }
  return grid;
}

Grid open_grid(const Pass& pass, const TrackingOptions& options) {
  Grid grid;
  const Eigen::Vector3d middle = middle_of_antennas(pass);
  const std::vector<double> shifts = steps(-options.reach_m, options.reach_m, kPlaceStep);
  for (const double x : shifts) {
    for (const double y : shifts) {
      grid.places.push_back(level(middle.x() + x, middle.y() + y, pass.height.mean_m));
    }
  }
  for (const double v : steps(options.min_speed_m_s, options.max_speed_m_s, kSpeedStep)) {
    // Heading steps are no finer than speed steps.
    const double step = std::max(kHeadingStep, std::min(kSpeedStep / v, kPi / 3.0));
    const int count = static_cast<int>(std::ceil(kTwoPi / step));
    for (int i = 0; i < count; ++i) {
      const double heading = kTwoPi * i / count;
      grid.velocities.push_back(level(v * std::cos(heading), v * std::sin(heading), 0.0));
    }
  }
  return grid;
}

/// Whether two motions are the same within these tolerances.
bool alike(const StraightMotion& a, const StraightMotion& b, double distance_m, double speed_m_s) {
  return (a.p_WT - b.p_WT).norm() < distance_m && (a.v_WT - b.v_WT).norm() < speed_m_s;
}

/// The best velocities of each position, then the best distinct ones.
std::vector<StraightMotion> coarse_hypotheses(const Pass& pass, const TrackingOptions& options) {
  const std::vector<RateTable> tables = rate_tables(pass, options);
  const Grid grid =
      options.lane ? lane_grid(pass, options, *options.lane) : open_grid(pass, options);
  std::vector<Scored> scored;
  scored.reserve(grid.places.size() * 4);
  for (const Eigen::Vector3d& place : grid.places) {
    std::vector<Scored> here;
    here.reserve(grid.velocities.size());
    for (const Eigen::Vector3d& velocity : grid.velocities) {
      here.push_back({{place, velocity}, score_of(tables, place, velocity)});
    }
    const std::size_t keep = std::min<std::size_t>(4, here.size());
    std::partial_sort(here.begin(), here.begin() + static_cast<std::ptrdiff_t>(keep), here.end(),
                      [](const Scored& a, const Scored& b) { return a.score > b.score; });
    scored.insert(scored.end(), here.begin(), here.begin() + static_cast<std::ptrdiff_t>(keep));
  }
  std::stable_sort(scored.begin(), scored.end(),
                   [](const Scored& a, const Scored& b) { return a.score > b.score; });
  std::vector<StraightMotion> chosen;
  for (const Scored& one : scored) {
    const bool known = std::any_of(chosen.begin(), chosen.end(), [&](const StraightMotion& other) {
      return alike(one.motion, other, 0.4, 0.3);
    });
    if (!known) chosen.push_back(one.motion);
    if (chosen.size() >= kCoarseHypotheses) break;
  }
  return chosen;
}

/// Keeps at most `most` hypotheses, best first, without duplicates.
void keep_best(std::vector<LineHypothesis>& hypotheses, std::size_t most) {
  std::stable_sort(hypotheses.begin(), hypotheses.end(), [](const auto& a, const auto& b) {
    return a.log_likelihood > b.log_likelihood;
  });
  std::vector<LineHypothesis> kept;
  for (const LineHypothesis& one : hypotheses) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const LineHypothesis& other) {
      return alike(one.fit.motion, other.fit.motion, 0.02, 0.02);
    });
    if (!known && kept.size() < most) kept.push_back(one);
  }
  hypotheses = std::move(kept);
}

LineHypothesis fitted(const Pass& pass, const std::vector<SubAperture>& apertures,
                      const MotionPrior& prior, double noise_rad, double aperture_s,
                      const StraightMotion& start) {
  LineHypothesis one;
  const bool whole = aperture_s >= duration_of(pass);
  one.fit = fit_line(pass, apertures, prior, noise_rad, whole, start);
  one.aperture_s = aperture_s;
  const auto count = static_cast<double>(pass.reads.size());
  one.log_likelihood =
      -count * (1.0 - one.fit.coherence) / (noise_rad * noise_rad) - one.fit.prior_cost;
  return one;
}

bool plausible(const TrackingOptions& options, const LineHypothesis& one) {
  const double speed = one.fit.motion.v_WT.head<2>().norm();
  if (options.lane && !options.lane->bidirectional) {
    const double heading = options.lane->heading_rad;
    const Eigen::Vector2d along(std::cos(heading), std::sin(heading));
    if (along.dot(one.fit.motion.v_WT.head<2>()) <= 0.0) return false;
  }
  return one.fit.motion.p_WT.allFinite() && one.fit.motion.v_WT.allFinite() &&
         speed <= 1.1 * options.max_speed_m_s && speed >= 0.5 * options.min_speed_m_s;
}

std::vector<LineHypothesis> fit_all(const Pass& pass, const TrackingOptions& options,
                                    double aperture_s, double noise_rad,
                                    const std::vector<StraightMotion>& starts) {
  const std::vector<SubAperture> apertures = sub_apertures(pass, aperture_s);
  const MotionPrior prior = motion_prior(pass, options);
  std::vector<LineHypothesis> hypotheses;
  for (const StraightMotion& start : starts) {
    LineHypothesis one = fitted(pass, apertures, prior, noise_rad, aperture_s, start);
    if (plausible(options, one)) hypotheses.push_back(one);
  }
  return hypotheses;
}

std::vector<StraightMotion> motions_of(const std::vector<LineHypothesis>& hypotheses) {
  std::vector<StraightMotion> motions;
  motions.reserve(hypotheses.size());
  for (const LineHypothesis& one : hypotheses) motions.push_back(one.fit.motion);
  return motions;
}

/// Doubles the length of the sub-apertures while the phase stays coherent.
std::vector<LineHypothesis> refined(const Pass& pass, const TrackingOptions& options,
                                    std::vector<LineHypothesis> hypotheses) {
  const double duration = duration_of(pass);
  std::size_t most = kCoarseHypotheses;
  double aperture_s = kShortest;
  const double before = hypotheses.empty() ? 0.0 : hypotheses.front().fit.coherence;
  while (!hypotheses.empty() && aperture_s < duration) {
    const double longer = 2.0 * aperture_s;
    aperture_s = longer >= duration ? duration + 1.0 : longer;
    most = std::max<std::size_t>(8, most * 2 / 3);
    const double noise = hypotheses.front().fit.noise_rad;
    auto next = fit_all(pass, options, aperture_s, noise, motions_of(hypotheses));
    keep_best(next, most);
    if (next.empty() || next.front().fit.coherence < kStaysCoherent * before) break;
    hypotheses = std::move(next);
  }
  return hypotheses;
}

}  // namespace

std::vector<StraightMotion> mirror_images(const Pass& pass, const StraightMotion& motion) {
  const Eigen::Vector3d middle = middle_of_antennas(pass);
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const PassRead& read : pass.reads) {
    const Eigen::Vector2d d = (read.p_WA - middle).head<2>();
    spread += d * d.transpose() / static_cast<double>(pass.reads.size());
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(spread);  // The iterative solver takes seconds to compile.
  if (solver.eigenvalues()(0) > kFlat * kFlat) return {};
  Eigen::Vector2d normal = solver.eigenvectors().col(0);
  if (solver.eigenvalues()(1) <= kFlat * kFlat) {
    const Eigen::Vector2d along = motion.v_WT.head<2>();
    if (along.norm() <= 0.0) return {};
    normal = Eigen::Vector2d(-along.y(), along.x()).normalized();
  }
  StraightMotion image = motion;
  image.p_WT.head<2>() -= 2.0 * normal.dot((motion.p_WT - middle).head<2>()) * normal;
  image.v_WT.head<2>() -= 2.0 * normal.dot(motion.v_WT.head<2>()) * normal;
  return {image};
}

LineHypothesis fitted_again(const Pass& pass, const TrackingOptions& options,
                            const LineHypothesis& hypothesis) {
  StraightMotion start = hypothesis.fit.motion;
  start.p_WT.z() = pass.height.mean_m;
  return fitted(pass, sub_apertures(pass, hypothesis.aperture_s), motion_prior(pass, options),
                hypothesis.fit.noise_rad, hypothesis.aperture_s, start);
}

std::vector<LineHypothesis> search_lines(const Pass& pass, const TrackingOptions& options,
                                         std::size_t most) {
  constexpr double kFirstNoise = 0.3;
  const std::vector<StraightMotion> coarse = coarse_hypotheses(pass, options);
  auto hypotheses = fit_all(pass, options, kShortest, kFirstNoise, coarse);
  keep_best(hypotheses, kCoarseHypotheses);
  hypotheses = refined(pass, options, std::move(hypotheses));
  if (hypotheses.empty()) return {};
  // Fits again with the best one's noise, to make likelihoods comparable, and with mirror images.
  std::vector<StraightMotion> starts = motions_of(hypotheses);
  const std::size_t count = std::min<std::size_t>(starts.size(), most);
  for (std::size_t i = 0; i < count; ++i) {
    for (const StraightMotion& image : mirror_images(pass, starts[i])) starts.push_back(image);
  }
  const LineHypothesis best = hypotheses.front();
  hypotheses = fit_all(pass, options, best.aperture_s, best.fit.noise_rad, starts);
  keep_best(hypotheses, most);
  return hypotheses;
}

}  // namespace tagfield
