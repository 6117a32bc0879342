#include "tagfield/localization/joint_system.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "tagfield/base/parallel.h"

namespace tagfield {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Index = Eigen::Index;

/// Keeps matrices invertible where nothing is told of an unknown [1/m²].
constexpr double kTiny = 1e-6;

/// Where a tag's unknowns are: its place first, then the offsets that are unknown.
struct Layout {
  int place = 0;             ///< 0 for a fixed tag, else 2 or 3.
  std::vector<int> of_span;  ///< Column of a span's offset, −1 where it is known.
  Index size = 0;
};

Layout layout_of(const JointTag& tag) {
  Layout layout;
  layout.place = tag.fixed ? 0 : tag.height.unknowns();
  int next = layout.place;
  for (const TagPhases::Span& span : tag.phases.spans) {
    layout.of_span.push_back(span.offset_known ? -1 : next);
    if (!span.offset_known) ++next;
  }
  layout.size = next;
  return layout;
}

/// The pose error's part of the normal equations: diagonal blocks, and those of each knot with the
/// next, side by side.
struct ChainPart {
  Eigen::MatrixXd diagonal;  ///< size × size·knots
  Eigen::MatrixXd next;      ///< Likewise; block k is that of rows k, columns k + 1.
  Eigen::VectorXd gradient;
};

ChainPart empty_chain(int size, Index knots) {
  return {Eigen::MatrixXd::Zero(size, size * knots), Eigen::MatrixXd::Zero(size, size * knots),
          Eigen::VectorXd::Zero(size * knots)};
}

/// One tag's part. `chain` covers only the tag's own knots.
struct TagPart {
  Layout layout;
  Eigen::MatrixXd normal;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd coupling;  ///< Rows: unknowns of the tag's knots. Columns: the tag's unknowns.
  ChainPart chain;
};

struct Linear {
  std::vector<TagPart> tags;
  ChainPart chain;
};

double nearest_to_zero(double error, double cycle) {
  return cycle > 0.0 ? error - cycle * std::round(error / cycle) : error;
}

Eigen::Vector3d padded(const Eigen::VectorXd& u, Index knot, int size) {
  Eigen::Vector3d all = Eigen::Vector3d::Zero();
  all.head(size) = u.segment(knot * size, size);
  return all;
}

/// Range and residual of one read where the system stands. The believed place holds the error, so
/// the antenna truly is at the believed place less the displacement.
struct ReadNow {
  Range range;
  double error = 0.0;
};

ReadNow read_now(const JointSystem& system, const JointTag& tag, std::size_t span, Index i) {
  const Eigen::Vector2d moved = displacement_at(system, tag, i);
  ReadNow now;
  now.range = range_to(tag.height, tag.fit.unknowns, tag.phases.x[i] - moved.x(),
                       tag.phases.y[i] - moved.y(), tag.phases.z[i]);
  now.error =
      nearest_to_zero(tag.phases.value[i] - now.range.r - tag.fit.offsets[static_cast<Index>(span)],
                      tag.phases.cycle[i]);
  return now;
}

/// Derivative of a read's range by the unknowns of a knot: the antenna moves back by the error.
Eigen::RowVector3d by_knot(const JointSystem& system, const JointTag& tag, Index i,
                           const PlaceVector& gradient, Index knot) {
  const Eigen::RowVector3d by_error(gradient[0], gradient[1],
                                    -gradient[0] * tag.lever_y[i] + gradient[1] * tag.lever_x[i]);
  return by_error * system.knots.scale[static_cast<std::size_t>(knot)];
}

/// Adds one read's products to the tag's part.
void add_read(const JointSystem& system, const JointTag& tag, std::size_t span, Index i,
              TagPart& part) {
  const ReadNow now = read_now(system, tag, span, i);
  const double k = tag.phases.wavenumber[i] / system.noise_rad;
  const double weight = k * k * tag.weight;
  const int place = part.layout.place;
  const int column = part.layout.of_span[span];
  const Eigen::Vector3d& g = now.range.gradient;
  const auto g_place = g.head(place);
  part.normal.topLeftCorner(place, place).noalias() += weight * g_place * g_place.transpose();
  part.gradient.head(place) += weight * now.error * g_place;
  if (column >= 0) {
    part.normal(column, column) += weight;
    part.normal.col(column).head(place) += weight * g_place;
    part.normal.row(column).head(place) += weight * g_place.transpose();
    part.gradient[column] += weight * now.error;
  }
  if (tag.knot[i] < 0) return;
  const int size = system.knots.size;
  const Index at = tag.knot[i] - tag.first_knot;
  const double w = tag.knot_weight[i];
  // Unknowns of the two knots side by side: the one before the read, and the next.
  Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 6> J(2 * size);
  J.head(size) = (1.0 - w) * by_knot(system, tag, i, g, tag.knot[i]).head(size);
  J.tail(size) = w * by_knot(system, tag, i, g, tag.knot[i] + 1).head(size);
  auto coupling = part.coupling.middleRows(at * size, 2 * size);
  coupling.leftCols(place).noalias() += weight * J.transpose() * g_place.transpose();
  if (column >= 0) coupling.col(column) += weight * J.transpose();
  part.chain.diagonal.middleCols(at * size, size).noalias() +=
      weight * J.head(size).transpose() * J.head(size);
  part.chain.diagonal.middleCols((at + 1) * size, size).noalias() +=
      weight * J.tail(size).transpose() * J.tail(size);
  part.chain.next.middleCols(at * size, size).noalias() +=
      weight * J.head(size).transpose() * J.tail(size);
  part.chain.gradient.segment(at * size, 2 * size) += weight * now.error * J.transpose();
}

TagPart part_of(const JointSystem& system, const JointTag& tag) {
  TagPart part;
  part.layout = layout_of(tag);
  const Index m = part.layout.size;
  part.normal = Eigen::MatrixXd::Zero(m, m);
  part.gradient = Eigen::VectorXd::Zero(m);
  part.coupling = Eigen::MatrixXd::Zero(tag.knot_count * system.knots.size, m);
  part.chain = empty_chain(system.knots.size, tag.knot_count);
  for (std::size_t s = 0; s < tag.phases.spans.size(); ++s) {
    const TagPhases::Span& span = tag.phases.spans[s];
    for (Index i = span.begin; i < span.begin + span.count; ++i) {
      add_read(system, tag, s, i, part);
    }
  }
  part.normal.diagonal().array() += kTiny;
  return part;
}

/// What is known of the pose error beforehand: uᵀ Λ u with the process' precision Λ.
void add_prior(const JointSystem& system, ChainPart& chain) {
  const int size = system.knots.size;
  for (const PoseKnots::Chain& of : system.knots.chains) {
    const double rho = system.knots.correlation(of);
    const double fresh = 1.0 / (1.0 - rho * rho);
    for (Index k = 0; k < of.count; ++k) {
      const Index at = (of.first + k) * size;
      const bool has_next = k + 1 < of.count;
      const double own = (k == 0 ? 1.0 : fresh) + (has_next ? rho * rho * fresh : 0.0);
      chain.diagonal.middleCols(at, size).diagonal().array() += own;
      chain.gradient.segment(at, size) -= own * system.u.segment(at, size);
      if (!has_next) continue;
      chain.next.middleCols(at, size).diagonal().array() -= rho * fresh;
      chain.gradient.segment(at, size) += rho * fresh * system.u.segment(at + size, size);
      chain.gradient.segment(at + size, size) += rho * fresh * system.u.segment(at, size);
    }
  }
}

double prior_cost(const JointSystem& system) {
  const int size = system.knots.size;
  double cost = 0.0;
  for (const PoseKnots::Chain& of : system.knots.chains) {
    const double rho = system.knots.correlation(of);
    const double fresh = 1.0 / (1.0 - rho * rho);
    cost += system.u.segment(of.first * size, size).squaredNorm();
    for (Index k = 1; k < of.count; ++k) {
      const Index at = (of.first + k) * size;
      cost += fresh *
              (system.u.segment(at, size) - rho * system.u.segment(at - size, size)).squaredNorm();
    }
  }
  return cost;
}

Linear linearize(const JointSystem& system, int threads) {
  const int size = system.knots.size;
  Linear linear;
  linear.tags.resize(system.tags.size());
  parallel_for(system.tags.size(), threads,
               [&](std::size_t j) { linear.tags[j] = part_of(system, system.tags[j]); });
  linear.chain = empty_chain(size, system.knots.count());
  for (std::size_t j = 0; j < system.tags.size(); ++j) {
    const Index begin = system.tags[j].first_knot * size;
    const Index count = system.tags[j].knot_count * size;
    const ChainPart& part = linear.tags[j].chain;
    linear.chain.diagonal.middleCols(begin, count) += part.diagonal;
    linear.chain.next.middleCols(begin, count) += part.next;
    linear.chain.gradient.segment(begin, count) += part.gradient;
  }
  add_prior(system, linear.chain);
  return linear;
}

void damp(Linear& linear, double damping) {
  for (TagPart& part : linear.tags) part.normal.diagonal() *= 1.0 + damping;
}

/// Block Cholesky factors of the chain: P = L Lᵀ with blocks on and below the diagonal.
struct ChainFactors {
  int size = 2;
  Eigen::MatrixXd own;    ///< Lower triangular blocks, side by side.
  Eigen::MatrixXd below;  ///< Block k is that of rows k + 1, columns k.
  double log_determinant = 0.0;
};

ChainFactors factorize(const ChainPart& chain, int size) {
  const Index knots = chain.gradient.size() / size;
  ChainFactors factors{size, chain.diagonal, Eigen::MatrixXd::Zero(size, size * knots), 0.0};
  for (Index k = 0; k < knots; ++k) {
    Eigen::MatrixXd block = factors.own.middleCols(k * size, size);
    const Eigen::LLT<Eigen::MatrixXd> cholesky(block);
    const Eigen::MatrixXd L = cholesky.matrixL();
    factors.own.middleCols(k * size, size) = L;
    factors.log_determinant += 2.0 * L.diagonal().array().log().sum();
    if (k + 1 == knots) break;
    // (L⁻¹ N)ᵀ for the block N beside the diagonal.
    const Eigen::MatrixXd below =
        L.triangularView<Eigen::Lower>().solve(chain.next.middleCols(k * size, size)).transpose();
    factors.below.middleCols(k * size, size) = below;
    factors.own.middleCols((k + 1) * size, size) -= below * below.transpose();
  }
  return factors;
}

/// L⁻¹ right, in place.
template <typename Matrix>
void solve_forward(const ChainFactors& factors, Matrix& right) {
  const int size = factors.size;
  const Index knots = factors.own.cols() / size;
  for (Index k = 0; k < knots; ++k) {
    auto rows = right.middleRows(k * size, size);
    if (k > 0) {
      rows.noalias() -=
          factors.below.middleCols((k - 1) * size, size) * right.middleRows((k - 1) * size, size);
    }
    factors.own.middleCols(k * size, size)
        .template triangularView<Eigen::Lower>()
        .solveInPlace(rows);
  }
}

/// L⁻ᵀ right, in place.
void solve_backward(const ChainFactors& factors, Eigen::VectorXd& right) {
  const int size = factors.size;
  const Index knots = factors.own.cols() / size;
  for (Index k = knots - 1; k >= 0; --k) {
    auto rows = right.segment(k * size, size);
    if (k + 1 < knots) {
      rows -= factors.below.middleCols(k * size, size).transpose() *
              right.segment((k + 1) * size, size);
    }
    factors.own.middleCols(k * size, size)
        .triangularView<Eigen::Lower>()
        .transpose()
        .solveInPlace(rows);
  }
}

std::vector<Index> starts_of(const Linear& linear) {
  std::vector<Index> starts{0};
  for (const TagPart& part : linear.tags) starts.push_back(starts.back() + part.layout.size);
  return starts;
}

/// How much the unknowns are to change.
struct Move {
  Eigen::VectorXd u;
  std::vector<Eigen::VectorXd> of_tag;
};

/// With the chain eliminated: the tags' own system, and what leads back.
struct Reduced {
  ChainFactors factors;
  std::vector<Index> starts;
  RowMajor couplings;  ///< L⁻¹ C.
  Eigen::LLT<Eigen::MatrixXd> tags;
};

Reduced reduce_to_tags(const JointSystem& system, const Linear& linear) {
  const int size = system.knots.size;
  Reduced reduced;
  reduced.starts = starts_of(linear);
  const Index unknowns = reduced.starts.back();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  reduced.couplings = RowMajor::Zero(linear.chain.gradient.size(), unknowns);
  for (std::size_t j = 0; j < linear.tags.size(); ++j) {
    const TagPart& part = linear.tags[j];
    const Index m = part.layout.size;
    normal.block(reduced.starts[j], reduced.starts[j], m, m) = part.normal;
    reduced.couplings.block(system.tags[j].first_knot * size, reduced.starts[j],
                            part.coupling.rows(), m) = part.coupling;
  }
  reduced.factors = factorize(linear.chain, size);
  solve_forward(reduced.factors, reduced.couplings);
  normal.selfadjointView<Eigen::Lower>().rankUpdate(reduced.couplings.transpose(), -1.0);
  reduced.tags.compute(normal.selfadjointView<Eigen::Lower>());
  return reduced;
}

Move solve_for_tags_first(const JointSystem& system, const Linear& linear) {
  const Reduced reduced = reduce_to_tags(system, linear);
  Eigen::VectorXd chain = linear.chain.gradient;
  solve_forward(reduced.factors, chain);
  Eigen::VectorXd right(reduced.starts.back());
  for (std::size_t j = 0; j < linear.tags.size(); ++j) {
    right.segment(reduced.starts[j], linear.tags[j].layout.size) = linear.tags[j].gradient;
  }
  right -= reduced.couplings.transpose() * chain;
  const Eigen::VectorXd solution = reduced.tags.solve(right);
  chain -= reduced.couplings * solution;
  solve_backward(reduced.factors, chain);
  Move move{chain, {}};
  for (std::size_t j = 0; j < linear.tags.size(); ++j) {
    move.of_tag.push_back(solution.segment(reduced.starts[j], linear.tags[j].layout.size));
  }
  return move;
}

/// With the tags eliminated: the knots' own system.
struct KnotSystem {
  std::vector<Eigen::LLT<Eigen::MatrixXd>> of_tag;  ///< Factors of each tag's own normal matrix.
  Eigen::LLT<Eigen::MatrixXd> knots;
  Eigen::VectorXd gradient;
};

Eigen::MatrixXd dense(const ChainPart& chain, int size) {
  const Index knots = chain.gradient.size() / size;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size * knots, size * knots);
  for (Index k = 0; k < knots; ++k) {
    matrix.block(k * size, k * size, size, size) = chain.diagonal.middleCols(k * size, size);
    if (k + 1 == knots) break;
    matrix.block((k + 1) * size, k * size, size, size) =
        chain.next.middleCols(k * size, size).transpose();
  }
  return matrix;
}

KnotSystem reduce_to_knots(const JointSystem& system, const Linear& linear) {
  const int size = system.knots.size;
  KnotSystem reduced;
  Eigen::MatrixXd normal = dense(linear.chain, size);
  reduced.gradient = linear.chain.gradient;
  for (std::size_t j = 0; j < linear.tags.size(); ++j) {
    const TagPart& part = linear.tags[j];
    reduced.of_tag.emplace_back(part.normal);
    const Index begin = system.tags[j].first_knot * size;
    const Index rows = part.coupling.rows();
    if (rows == 0) continue;
    const Eigen::MatrixXd root = reduced.of_tag.back().matrixL().solve(part.coupling.transpose());
    normal.block(begin, begin, rows, rows)
        .selfadjointView<Eigen::Lower>()
        .rankUpdate(root.transpose(), -1.0);
    reduced.gradient.segment(begin, rows) -=
        part.coupling * reduced.of_tag.back().solve(part.gradient);
  }
  reduced.knots.compute(normal.selfadjointView<Eigen::Lower>());
  return reduced;
}

Move solve_for_knots_first(const JointSystem& system, const Linear& linear) {
  const KnotSystem reduced = reduce_to_knots(system, linear);
  Move move{reduced.knots.solve(reduced.gradient), {}};
  for (std::size_t j = 0; j < linear.tags.size(); ++j) {
    const TagPart& part = linear.tags[j];
    const Index begin = system.tags[j].first_knot * system.knots.size;
    move.of_tag.push_back(reduced.of_tag[j].solve(
        part.gradient - part.coupling.transpose() * move.u.segment(begin, part.coupling.rows())));
  }
  return move;
}

bool knots_first(const JointSystem& system, const Linear& linear) {
  std::vector<Index> unknowns;
  for (const TagPart& part : linear.tags) unknowns.push_back(part.layout.size);
  return eliminates_knots_first(system.knots.count() * system.knots.size, unknowns);
}

Move solve(const JointSystem& system, const Linear& linear) {
  return knots_first(system, linear) ? solve_for_tags_first(system, linear)
                                     : solve_for_knots_first(system, linear);
}

void apply(const Move& move, JointSystem& system) {
  system.u += move.u;
  for (std::size_t j = 0; j < system.tags.size(); ++j) {
    JointTag& tag = system.tags[j];
    const Layout layout = layout_of(tag);
    tag.fit.unknowns.head(layout.place) += move.of_tag[j].head(layout.place);
    for (std::size_t s = 0; s < layout.of_span.size(); ++s) {
      if (layout.of_span[s] < 0) continue;
      tag.fit.offsets[static_cast<Index>(s)] += move.of_tag[j][layout.of_span[s]];
    }
  }
}

bool is_finite(const Move& move) {
  return move.u.allFinite() &&
         std::all_of(move.of_tag.begin(), move.of_tag.end(),
                     [](const Eigen::VectorXd& of_tag) { return of_tag.allFinite(); });
}

/// Greatest change of a place [m].
double length_of(const JointSystem& system, const Move& move) {
  double most = 0.0;
  for (std::size_t j = 0; j < system.tags.size(); ++j) {
    if (system.tags[j].fixed || move.of_tag[j].size() < 2) continue;
    most = std::max(most, move.of_tag[j].head<2>().norm());
  }
  return most;
}

Eigen::Matrix3d place_block(const Layout& layout, const Eigen::MatrixXd& covariance) {
  Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
  block.topLeftCorner(layout.place, layout.place) =
      covariance.topLeftCorner(layout.place, layout.place);
  return block;
}

JointCovariance covariance_by_tags(const JointSystem& system, const Linear& linear) {
  const Reduced reduced = reduce_to_tags(system, linear);
  const Index unknowns = reduced.starts.back();
  const Eigen::MatrixXd all = reduced.tags.solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
  const auto tags = static_cast<Index>(linear.tags.size());
  JointCovariance covariance;
  covariance.of_all = Eigen::MatrixXd::Zero(3 * tags, 3 * tags);
  for (Index i = 0; i < tags; ++i) {
    const auto a = static_cast<std::size_t>(i);
    const int rows = linear.tags[a].layout.place;
    for (Index j = 0; j < tags; ++j) {
      const auto b = static_cast<std::size_t>(j);
      const int columns = linear.tags[b].layout.place;
      covariance.of_all.block(3 * i, 3 * j, rows, columns) =
          all.block(reduced.starts[a], reduced.starts[b], rows, columns);
    }
    covariance.of_tag.push_back(covariance.of_all.block<3, 3>(3 * i, 3 * i));
  }
  const Eigen::MatrixXd factor = reduced.tags.matrixL();
  covariance.log_determinant =
      reduced.factors.log_determinant + 2.0 * factor.diagonal().array().log().sum();
  return covariance;
}

JointCovariance covariance_by_knots(const JointSystem& system, const Linear& linear, int threads) {
  const KnotSystem reduced = reduce_to_knots(system, linear);
  const std::size_t tags = linear.tags.size();
  JointCovariance covariance;
  covariance.of_tag.resize(tags);
  parallel_for(tags, threads, [&](std::size_t j) {
    const TagPart& part = linear.tags[j];
    const Index m = part.layout.size;
    const Index begin = system.tags[j].first_knot * system.knots.size;
    // cov = T⁻¹ + W (S⁻¹) Wᵀ with W = T⁻¹ Cᵀ, of the place's rows only.
    const Eigen::MatrixXd columns =
        reduced.of_tag[j].solve(Eigen::MatrixXd::Identity(m, part.layout.place));
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(reduced.gradient.size(), part.layout.place);
    right.middleRows(begin, part.coupling.rows()) = part.coupling * columns;
    reduced.knots.matrixL().solveInPlace(right);
    const Eigen::MatrixXd sum = columns.topRows(part.layout.place) + right.transpose() * right;
    covariance.of_tag[j] = place_block(part.layout, sum);
  });
  covariance.of_all =
      Eigen::MatrixXd::Zero(3 * static_cast<Index>(tags), 3 * static_cast<Index>(tags));
  for (std::size_t j = 0; j < tags; ++j) {
    const auto at = 3 * static_cast<Index>(j);
    covariance.of_all.block<3, 3>(at, at) = covariance.of_tag[j];
    const Eigen::MatrixXd factor = reduced.of_tag[j].matrixL();
    covariance.log_determinant += 2.0 * factor.diagonal().array().log().sum();
  }
  const Eigen::MatrixXd factor = reduced.knots.matrixL();
  covariance.log_determinant += 2.0 * factor.diagonal().array().log().sum();
  return covariance;
}

}  // namespace

void attach(const LocalizationProblem& problem, const PoseKnots& knots, JointTag& tag) {
  const Index reads = tag.phases.size();
  tag.knot = Eigen::ArrayXi::Constant(reads, -1);
  tag.knot_weight = Eigen::ArrayXd::Zero(reads);
  tag.lever_x = Eigen::ArrayXd::Zero(reads);
  tag.lever_y = Eigen::ArrayXd::Zero(reads);
  int first = 0;
  int last = -1;
  for (const TagPhases::Span& span : tag.phases.spans) {
    const auto found = knots.chain_of.find(span.antenna);
    if (found == knots.chain_of.end()) continue;
    const PoseKnots::Chain& chain = knots.chains[found->second];
    const Trajectory& reference = problem.tracks.at(chain.reference).X_WA;
    for (Index i = span.begin; i < span.begin + span.count; ++i) {
      const KnotPlace place = place_in(chain, tag.phases.time_s[i]);
      tag.knot[i] = static_cast<int>(place.at);
      tag.knot_weight[i] = place.weight;
      first = last < 0 ? tag.knot[i] : std::min(first, tag.knot[i]);
      last = std::max(last, tag.knot[i] + 1);
      if (span.antenna == chain.reference) continue;
      const RigidTransform X_WR = held_pose_at(reference, time_from_seconds(tag.phases.time_s[i]));
      tag.lever_x[i] = tag.phases.x[i] - X_WR.translation.x();
      tag.lever_y[i] = tag.phases.y[i] - X_WR.translation.y();
    }
  }
  tag.first_knot = first;
  tag.knot_count = last < 0 ? 0 : last - first + 1;
}

Eigen::Vector2d displacement_at(const JointSystem& system, const JointTag& tag, Index i) {
  const Index at = tag.knot[i];
  if (at < 0) return Eigen::Vector2d::Zero();
  const PoseKnots& knots = system.knots;
  const double w = tag.knot_weight[i];
  const auto k = static_cast<std::size_t>(at);
  const Eigen::Vector3d error = (1.0 - w) * (knots.scale[k] * padded(system.u, at, knots.size)) +
                                w * (knots.scale[k + 1] * padded(system.u, at + 1, knots.size));
  const double yaw = knots.size == 3 ? error.z() : 0.0;
  return {error.x() - yaw * tag.lever_y[i], error.y() + yaw * tag.lever_x[i]};
}

double cost_of(JointSystem& system) {
  double total = prior_cost(system);
  for (JointTag& tag : system.tags) {
    double cost = 0.0;
    for (std::size_t s = 0; s < tag.phases.spans.size(); ++s) {
      const TagPhases::Span& span = tag.phases.spans[s];
      for (Index i = span.begin; i < span.begin + span.count; ++i) {
        const double error = read_now(system, tag, s, i).error * tag.phases.wavenumber[i];
        cost += error * error;
      }
    }
    tag.fit.cost = cost;
    total += cost * tag.weight / (system.noise_rad * system.noise_rad);
  }
  return total;
}

double minimize(JointSystem& system, int rounds, int threads) {
  constexpr double kTolerance = 2e-6;  // [m]
  double damping = 1e-6;
  double cost = cost_of(system);
  for (int round = 0; round < rounds; ++round) {
    Linear linear = linearize(system, threads);
    damp(linear, damping);
    const Move move = solve(system, linear);
    if (!is_finite(move)) {
      damping = std::max(10.0 * damping, 1e-3);
      continue;
    }
    JointSystem next = system;
    apply(move, next);
    const double there = cost_of(next);
    const double length = length_of(system, move);
    if (there <= cost) {
      system = std::move(next);
      const double gain = cost - there;
      cost = there;
      damping = std::max(0.1 * damping, 1e-9);
      if (length < kTolerance || gain < 1e-7 * cost) break;
    } else {
      if (length < kTolerance) break;
      damping = std::max(10.0 * damping, 1e-3);
    }
  }
  return cost_of(system);
}

JointCovariance covariance_of(const JointSystem& system, int threads) {
  const Linear linear = linearize(system, threads);
  return knots_first(system, linear) ? covariance_by_tags(system, linear)
                                     : covariance_by_knots(system, linear, threads);
}

double evidence(const JointSystem& system, double cost, double log_determinant) {
  // ln |Λ| of the prior: each step of a chain has the precision 1/(1 − ρ²) in each unknown.
  double prior = 0.0;
  for (const PoseKnots::Chain& chain : system.knots.chains) {
    const double rho = system.knots.correlation(chain);
    prior -= static_cast<double>((chain.count - 1) * system.knots.size) * std::log1p(-rho * rho);
  }
  return cost + log_determinant - prior;
}

bool eliminates_knots_first(Index knot_unknowns, const std::vector<Index>& unknowns) {
  double all = 0.0;
  double by_tags = 0.0;
  const auto knots = static_cast<double>(knot_unknowns);
  for (const Index m : unknowns) {
    const auto count = static_cast<double>(m);
    all += count;
    by_tags += knots * knots * count;
  }
  return knots * all * all + all * all * all / 3.0 < by_tags + knots * knots * knots / 3.0;
}

}  // namespace tagfield
