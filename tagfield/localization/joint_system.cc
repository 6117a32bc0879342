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

/// Blocks of D × D side by side, one a knot.
template <int D>
using Blocks = Eigen::Matrix<double, D, Eigen::Dynamic>;

/// The pose error's part of the normal equations, with D unknowns a knot.
template <int D>
struct ChainPart {
  Blocks<D> diagonal;
  Blocks<D> next;  ///< Block k is that of rows k, columns k + 1.
  Eigen::VectorXd gradient;
};

template <int D>
ChainPart<D> empty_chain(Index knots) {
  return {Blocks<D>::Zero(D, D * knots), Blocks<D>::Zero(D, D * knots),
          Eigen::VectorXd::Zero(D * knots)};
}

/// One tag's part. `chain` covers only the tag's own knots.
template <int D>
struct TagPart {
  Layout layout;
  Eigen::MatrixXd normal;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd coupling;  ///< Rows: unknowns of the tag's knots. Columns: the tag's unknowns.
  ChainPart<D> chain;
};

template <int D>
struct Linear {
  std::vector<TagPart<D>> tags;
  ChainPart<D> chain;
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
template <int D>
Eigen::Matrix<double, D, 1> by_knot(const JointSystem& system, const JointTag& tag, Index i,
                                    const PlaceVector& gradient, Index knot) {
  const Eigen::Vector3d by_error(gradient[0], gradient[1],
                                 -gradient[0] * tag.lever_y[i] + gradient[1] * tag.lever_x[i]);
  const Eigen::Matrix3d& scale = system.knots.scale[static_cast<std::size_t>(knot)];
  return scale.topLeftCorner<D, D>().transpose() * by_error.head<D>();
}

/// Adds one read's products with the pose error.
template <int D>
void add_to_knots(const JointSystem& system, const JointTag& tag, Index i, int column,
                  const ReadNow& now, double weight, TagPart<D>& part) {
  const Index before = (tag.knot[i] - tag.first_knot) * Index{D};
  const Index after = before + D;
  const double w = tag.knot_weight[i];
  using Vector = Eigen::Matrix<double, D, 1>;
  const Eigen::Vector3d& g = now.range.gradient;
  const Vector a = (1.0 - w) * by_knot<D>(system, tag, i, g, tag.knot[i]);
  const Vector b = w * by_knot<D>(system, tag, i, g, tag.knot[i] + 1);
  for (int c = 0; c < part.layout.place; ++c) {
    part.coupling.col(c).template segment<D>(before) += weight * g[c] * a;
    part.coupling.col(c).template segment<D>(after) += weight * g[c] * b;
  }
  if (column >= 0) {
    part.coupling.col(column).template segment<D>(before) += weight * a;
    part.coupling.col(column).template segment<D>(after) += weight * b;
  }
  part.chain.diagonal.template middleCols<D>(before) += (weight * a) * a.transpose();
  part.chain.diagonal.template middleCols<D>(after) += (weight * b) * b.transpose();
  part.chain.next.template middleCols<D>(before) += (weight * a) * b.transpose();
  part.chain.gradient.template segment<D>(before) += weight * now.error * a;
  part.chain.gradient.template segment<D>(after) += weight * now.error * b;
}

/// Adds one read's products to the tag's part.
template <int D>
void add_read(const JointSystem& system, const JointTag& tag, std::size_t span, Index i,
              TagPart<D>& part) {
  const ReadNow now = read_now(system, tag, span, i);
  const double k = tag.phases.wavenumber[i] / system.noise_rad;
  const double weight = k * k * tag.weight;
  const int place = part.layout.place;
  const int column = part.layout.of_span[span];
  const Eigen::Vector3d& g = now.range.gradient;
  for (int c = 0; c < place; ++c) {
    for (int r = 0; r < place; ++r) part.normal(r, c) += weight * g[r] * g[c];
    part.gradient[c] += weight * now.error * g[c];
  }
  if (column >= 0) {
    part.normal(column, column) += weight;
    for (int c = 0; c < place; ++c) {
      part.normal(column, c) += weight * g[c];
      part.normal(c, column) += weight * g[c];
    }
    part.gradient[column] += weight * now.error;
  }
  if (tag.knot[i] >= 0) add_to_knots(system, tag, i, column, now, weight, part);
}

template <int D>
TagPart<D> part_of(const JointSystem& system, const JointTag& tag) {
  TagPart<D> part;
  part.layout = layout_of(tag);
  const Index m = part.layout.size;
  part.normal = Eigen::MatrixXd::Zero(m, m);
  part.gradient = Eigen::VectorXd::Zero(m);
  part.coupling = Eigen::MatrixXd::Zero(tag.knot_count * Index{D}, m);
  part.chain = empty_chain<D>(tag.knot_count);
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
template <int D>
void add_prior(const JointSystem& system, ChainPart<D>& chain) {
  constexpr int size = D;
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

template <int D>
Linear<D> linearize(const JointSystem& system, int threads) {
  Linear<D> linear;
  linear.tags.resize(system.tags.size());
  parallel_for(system.tags.size(), threads,
               [&](std::size_t j) { linear.tags[j] = part_of<D>(system, system.tags[j]); });
  linear.chain = empty_chain<D>(system.knots.count());
  for (std::size_t j = 0; j < system.tags.size(); ++j) {
    const Index begin = system.tags[j].first_knot * Index{D};
    const Index count = system.tags[j].knot_count * Index{D};
    const ChainPart<D>& part = linear.tags[j].chain;
    linear.chain.diagonal.middleCols(begin, count) += part.diagonal;
    linear.chain.next.middleCols(begin, count) += part.next;
    linear.chain.gradient.segment(begin, count) += part.gradient;
  }
  add_prior(system, linear.chain);
  return linear;
}

template <int D>
void damp(Linear<D>& linear, double damping) {
  for (TagPart<D>& part : linear.tags) part.normal.diagonal() *= 1.0 + damping;
}

/// Block Cholesky factors of the chain: P = L Lᵀ with blocks on and below the diagonal.
template <int D>
struct ChainFactors {
  Blocks<D> own;    ///< Lower triangular.
  Blocks<D> below;  ///< Block k is that of rows k + 1, columns k.
  double log_determinant = 0.0;
};

template <int D>
ChainFactors<D> factorize(const ChainPart<D>& chain) {
  using Block = Eigen::Matrix<double, D, D>;
  const Index knots = chain.gradient.size() / D;
  ChainFactors<D> factors{chain.diagonal, Blocks<D>::Zero(D, D * knots), 0.0};
  for (Index k = 0; k < knots; ++k) {
    const Block block = factors.own.template middleCols<D>(k * D);
    const Block L = block.llt().matrixL();
    factors.own.template middleCols<D>(k * D) = L;
    factors.log_determinant += 2.0 * L.diagonal().array().log().sum();
    if (k + 1 == knots) break;
    const Block next = chain.next.template middleCols<D>(k * D);
    // (L⁻¹ N)ᵀ for the block N beside the diagonal.
    const Block below = L.template triangularView<Eigen::Lower>().solve(next).transpose();
    factors.below.template middleCols<D>(k * D) = below;
    factors.own.template middleCols<D>((k + 1) * D) -= below * below.transpose();
  }
  return factors;
}

/// L⁻¹ right, in place; row by row, which lie one after the other.
template <int D, typename Matrix>
void solve_forward(const ChainFactors<D>& factors, Matrix& right) {
  const Index knots = factors.own.cols() / D;
  for (Index k = 0; k < knots; ++k) {
    for (int r = 0; r < D; ++r) {
      auto row = right.row(k * D + r);
      for (int c = 0; c < D && k > 0; ++c) {
        row -= factors.below(r, (k - 1) * D + c) * right.row((k - 1) * D + c);
      }
      for (int c = 0; c < r; ++c) row -= factors.own(r, k * D + c) * right.row(k * D + c);
      row *= 1.0 / factors.own(r, k * D + r);
    }
  }
}

/// L⁻ᵀ right, in place.
template <int D>
void solve_backward(const ChainFactors<D>& factors, Eigen::VectorXd& right) {
  using Block = Eigen::Matrix<double, D, D>;
  const Index knots = factors.own.cols() / D;
  for (Index k = knots - 1; k >= 0; --k) {
    Eigen::Matrix<double, D, 1> rows = right.template segment<D>(k * D);
    if (k + 1 < knots) {
      const Block below = factors.below.template middleCols<D>(k * D);
      rows -= below.transpose() * right.template segment<D>((k + 1) * D);
    }
    const Block L = factors.own.template middleCols<D>(k * D);
    right.template segment<D>(k * D) =
        L.template triangularView<Eigen::Lower>().transpose().solve(rows);
  }
}

template <int D>
std::vector<Index> starts_of(const Linear<D>& linear) {
  std::vector<Index> starts{0};
  for (const TagPart<D>& part : linear.tags) starts.push_back(starts.back() + part.layout.size);
  return starts;
}

/// How much the unknowns are to change.
struct Move {
  Eigen::VectorXd u;
  std::vector<Eigen::VectorXd> of_tag;
};

/// With the chain eliminated: the tags' own system, and what leads back.
template <int D>
struct Reduced {
  ChainFactors<D> factors;
  std::vector<Index> starts;
  RowMajor couplings;  ///< L⁻¹ C.
  Eigen::LLT<Eigen::MatrixXd> tags;
};

template <int D>
Reduced<D> reduce_to_tags(const JointSystem& system, const Linear<D>& linear) {
  Reduced<D> reduced;
  reduced.starts = starts_of(linear);
  const Index unknowns = reduced.starts.back();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  reduced.couplings = RowMajor::Zero(linear.chain.gradient.size(), unknowns);
  for (std::size_t j = 0; j < linear.tags.size(); ++j) {
    const TagPart<D>& part = linear.tags[j];
    const Index m = part.layout.size;
    normal.block(reduced.starts[j], reduced.starts[j], m, m) = part.normal;
    reduced.couplings.block(system.tags[j].first_knot * D, reduced.starts[j], part.coupling.rows(),
                            m) = part.coupling;
  }
  reduced.factors = factorize<D>(linear.chain);
  solve_forward(reduced.factors, reduced.couplings);
  normal.selfadjointView<Eigen::Lower>().rankUpdate(reduced.couplings.transpose(), -1.0);
  reduced.tags.compute(normal.selfadjointView<Eigen::Lower>());
  return reduced;
}

template <int D>
Move solve_for_tags_first(const JointSystem& system, const Linear<D>& linear) {
  const Reduced<D> reduced = reduce_to_tags(system, linear);
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

template <int D>
Eigen::MatrixXd dense(const ChainPart<D>& chain) {
  constexpr int size = D;
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

template <int D>
KnotSystem reduce_to_knots(const JointSystem& system, const Linear<D>& linear) {
  KnotSystem reduced;
  Eigen::MatrixXd normal = dense(linear.chain);
  reduced.gradient = linear.chain.gradient;
  for (std::size_t j = 0; j < linear.tags.size(); ++j) {
    const TagPart<D>& part = linear.tags[j];
    reduced.of_tag.emplace_back(part.normal);
    const Index begin = system.tags[j].first_knot * Index{D};
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

template <int D>
Move solve_for_knots_first(const JointSystem& system, const Linear<D>& linear) {
  const KnotSystem reduced = reduce_to_knots(system, linear);
  Move move{reduced.knots.solve(reduced.gradient), {}};
  for (std::size_t j = 0; j < linear.tags.size(); ++j) {
    const TagPart<D>& part = linear.tags[j];
    const Index begin = system.tags[j].first_knot * Index{system.knots.size};
    move.of_tag.push_back(reduced.of_tag[j].solve(
        part.gradient - part.coupling.transpose() * move.u.segment(begin, part.coupling.rows())));
  }
  return move;
}

template <int D>
bool knots_first(const JointSystem& system, const Linear<D>& linear) {
  std::vector<Index> unknowns;
  for (const TagPart<D>& part : linear.tags) unknowns.push_back(part.layout.size);
  return eliminates_knots_first(system.knots.count() * system.knots.size, unknowns);
}

template <int D>
Move solve(const JointSystem& system, const Linear<D>& linear) {
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

template <int D>
JointCovariance covariance_by_tags(const JointSystem& system, const Linear<D>& linear) {
  const Reduced<D> reduced = reduce_to_tags(system, linear);
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

template <int D>
JointCovariance covariance_by_knots(const JointSystem& system, const Linear<D>& linear,
                                    int threads) {
  const KnotSystem reduced = reduce_to_knots(system, linear);
  const std::size_t tags = linear.tags.size();
  JointCovariance covariance;
  covariance.of_tag.resize(tags);
  parallel_for(tags, threads, [&](std::size_t j) {
    const TagPart<D>& part = linear.tags[j];
    const Index m = part.layout.size;
    const Index begin = system.tags[j].first_knot * Index{system.knots.size};
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

template <int D>
JointCovariance whole_covariance(const JointSystem& system, int threads) {
  const Linear<D> linear = linearize<D>(system, threads);
  return knots_first(system, linear) ? covariance_by_tags(system, linear)
                                     : covariance_by_knots(system, linear, threads);
}

template <int D>
Move damped_move(const JointSystem& system, double damping, int threads) {
  Linear<D> linear = linearize<D>(system, threads);
  damp(linear, damping);
  return solve(system, linear);
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
  constexpr double kLeastGain = 1e-4;  // A hundredth of a standard deviation is 1e-4 in the cost.
  double damping = 1e-6;
  double cost = cost_of(system);
  for (int round = 0; round < rounds; ++round) {
    const Move move = system.knots.size == 3 ? damped_move<3>(system, damping, threads)
                                             : damped_move<2>(system, damping, threads);
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
      if (length < kTolerance || gain < kLeastGain) break;
    } else {
      if (length < kTolerance) break;
      damping = std::max(10.0 * damping, 1e-3);
    }
  }
  return cost_of(system);
}

JointCovariance covariance_of(const JointSystem& system, int threads) {
  return system.knots.size == 3 ? whole_covariance<3>(system, threads)
                                : whole_covariance<2>(system, threads);
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
