// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/joint_solution.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "tagfield/base/parallel.h"
#include "tagfield/fit/envelope_matrix.h"
#include "tagfield/localization/joint/internal/joint_equations.h"

namespace tagfield {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Index = Eigen::Index;

template <int D>
void damp(Linear<D>& linear, double damping) {
  for (TagPart<D>& part : linear.tags) part.normal.diagonal() *= 1.0 + damping;
}

/// Block Cholesky factors of the chain: P = L Lᵀ with blocks on and below the diagonal.
template <int D>
struct ChainFactors {
  Blocks<D> own;    ///< Lower triangular.
  Blocks<D> below;  ///< Block k has rows k + 1 and columns k.
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

/// L⁻¹ right, in place; row by row, as rows are contiguous.
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

void add_at(const std::vector<Index>& rows, const Eigen::VectorXd& values, Eigen::VectorXd& all) {
  for (std::size_t k = 0; k < rows.size(); ++k) all[rows[k]] += values[static_cast<Index>(k)];
}

Eigen::VectorXd taken_from(const std::vector<Index>& rows, const Eigen::VectorXd& all) {
  Eigen::VectorXd values(static_cast<Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) values[static_cast<Index>(k)] = all[rows[k]];
  return values;
}

template <int D>
std::vector<Index> starts_of(const Linear<D>& linear) {
  std::vector<Index> starts{0};
  for (const TagPart<D>& part : linear.tags) starts.push_back(starts.back() + part.layout.size);
  return starts;
}

/// With the chain eliminated: the reduced system of the tags, and the data for back substitution.
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
    for (std::size_t k = 0; k < system.tags[j].knots.size(); ++k) {
      reduced.couplings.block(system.tags[j].knots[k] * D, reduced.starts[j], D, m) =
          part.coupling.middleRows(static_cast<Index>(k) * D, D);
    }
  }
  reduced.factors = factorize<D>(linear.chain);
  solve_forward(reduced.factors, reduced.couplings);
  if (unknowns > 0) {
    normal.selfadjointView<Eigen::Lower>().rankUpdate(reduced.couplings.transpose(), -1.0);
  }
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

/// First nonzero column of each row of the knots' matrix after eliminating the tags: each tag
/// couples all of its knots.
template <int D>
std::vector<Index> knot_envelope(const JointSystem& system) {
  std::vector<Index> firsts(static_cast<std::size_t>(system.knots.count()));
  for (std::size_t k = 1; k < firsts.size(); ++k) firsts[k] = static_cast<Index>(k) - 1;
  for (const JointTag& tag : system.tags) {
    for (const Index knot : tag.knots) {
      Index& first = firsts[static_cast<std::size_t>(knot)];
      first = std::min(first, tag.knots.front());
    }
  }
  std::vector<Index> of_unknowns;
  for (const Index first : firsts) of_unknowns.insert(of_unknowns.end(), D, first * D);
  return of_unknowns;
}

/// With the tags eliminated: the reduced system of the knots.
struct KnotSystem {
  std::vector<Eigen::LLT<Eigen::MatrixXd>> of_tag;  ///< Factors of each tag's own normal matrix.
  EnvelopeMatrix knots;                             ///< Its factor.
  bool is_definite = false;
  Eigen::VectorXd gradient;
};

template <int D>
void add_chain(const ChainPart<D>& chain, EnvelopeMatrix& matrix) {
  const Index knots = chain.gradient.size() / D;
  for (Index k = 0; k < knots; ++k) {
    const Index size = k + 1 == knots ? D : 2 * D;
    Eigen::MatrixXd block = Eigen::MatrixXd::Zero(size, size);
    block.topLeftCorner(D, D) = chain.diagonal.middleCols(k * D, D);
    std::vector<Index> pair{k};
    if (size > D) {
      block.bottomLeftCorner(D, D) = chain.next.middleCols(k * D, D).transpose();
      pair.push_back(k + 1);
    }
    matrix.add(unknowns_of<D>(pair), block);
  }
}

/// Update of the knots' part of the system by the elimination of a tag.
struct Taken {
  Eigen::LLT<Eigen::MatrixXd> factors;  ///< Of the tag's own normal matrix.
  Eigen::MatrixXd normal;               ///< The lower triangle.
  Eigen::VectorXd gradient;
};

template <int D>
Taken eliminated(const TagPart<D>& part) {
  Taken taken{Eigen::LLT<Eigen::MatrixXd>(part.normal), {}, {}};
  const Index rows = part.coupling.rows();
  if (rows == 0) return {std::move(taken.factors), Eigen::MatrixXd(0, 0), Eigen::VectorXd(0)};
  const Eigen::MatrixXd root = taken.factors.matrixL().solve(part.coupling.transpose());
  taken.normal = Eigen::MatrixXd::Zero(rows, rows);
  taken.normal.template selfadjointView<Eigen::Lower>().rankUpdate(root.transpose(), -1.0);
  taken.gradient = -part.coupling * taken.factors.solve(part.gradient);
  return taken;
}

template <int D>
KnotSystem reduce_to_knots(const JointSystem& system, const Linear<D>& linear, int threads) {
  constexpr std::size_t kTagsAtOnce = 8;  // Their updates are dense.
  KnotSystem reduced{{}, EnvelopeMatrix(knot_envelope<D>(system)), false, linear.chain.gradient};
  add_chain<D>(linear.chain, reduced.knots);
  std::vector<Taken> taken(kTagsAtOnce);
  for (std::size_t begin = 0; begin < linear.tags.size(); begin += kTagsAtOnce) {
    const std::size_t count = std::min(kTagsAtOnce, linear.tags.size() - begin);
    parallel_for(count, threads,
                 [&](std::size_t j) { taken[j] = eliminated<D>(linear.tags[begin + j]); });
    for (std::size_t j = 0; j < count; ++j) {
      const std::vector<Index> rows = unknowns_of<D>(system.tags[begin + j].knots);
      reduced.knots.add(rows, taken[j].normal);
      add_at(rows, taken[j].gradient, reduced.gradient);
      reduced.of_tag.push_back(std::move(taken[j].factors));
    }
  }
  reduced.is_definite = reduced.knots.factorize(threads);
  return reduced;
}

template <int D>
Move solve_for_knots_first(const JointSystem& system, const Linear<D>& linear, int threads) {
  const KnotSystem reduced = reduce_to_knots(system, linear, threads);
  Move move{reduced.knots.solve(reduced.gradient), {}};
  // As when Eigen's factorization fails: the step is rejected.
  if (!reduced.is_definite) move.u.setConstant(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t j = 0; j < linear.tags.size(); ++j) {
    const TagPart<D>& part = linear.tags[j];
    move.of_tag.push_back(reduced.of_tag[j].solve(
        part.gradient -
        part.coupling.transpose() * taken_from(unknowns_of<D>(system.tags[j].knots), move.u)));
  }
  return move;
}

template <int D>
bool knots_first(const JointSystem& system, const Linear<D>& linear) {
  Index unknowns = 0;
  // Tiles use wide vector instructions, about three times as fast as Eigen.
  double work = 2.0 / 3.0 * work_of_factors(knot_envelope<D>(system));
  for (const TagPart<D>& part : linear.tags) {
    unknowns += part.layout.size;
    const auto rows = static_cast<double>(part.coupling.rows());
    work += rows * rows * static_cast<double>(part.layout.size);
  }
  return eliminates_knots_first(system.knots.count() * D, unknowns, work);
}

template <int D>
Move solve(const JointSystem& system, const Linear<D>& linear, int threads) {
  return knots_first(system, linear) ? solve_for_tags_first(system, linear)
                                     : solve_for_knots_first(system, linear, threads);
}

double log_determinant(const Eigen::LLT<Eigen::MatrixXd>& factors) {
  return 2.0 * factors.matrixLLT().diagonal().array().log().sum();
}

template <int D>
double log_determinant(const Reduced<D>& reduced) {
  return reduced.factors.log_determinant + log_determinant(reduced.tags);
}

double log_determinant(const KnotSystem& reduced) {
  double sum = reduced.knots.log_determinant();
  for (const Eigen::LLT<Eigen::MatrixXd>& of_tag : reduced.of_tag) sum += log_determinant(of_tag);
  return sum;
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
  covariance.log_determinant = log_determinant(reduced);
  return covariance;
}

template <int D>
JointCovariance covariance_by_knots(const JointSystem& system, const Linear<D>& linear,
                                    int threads) {
  KnotSystem reduced = reduce_to_knots(system, linear, threads);
  const std::size_t tags = linear.tags.size();
  JointCovariance covariance;
  covariance.log_determinant = log_determinant(reduced);
  reduced.knots.invert(threads);
  covariance.of_tag.assign(tags, Eigen::Matrix3d::Zero());
  parallel_for(tags, threads, [&](std::size_t j) {
    const TagPart<D>& part = linear.tags[j];
    if (part.layout.place == 0) return;  // Its position is known.
    // T⁻¹ + W S⁻¹ Wᵀ with W = T⁻¹ Cᵀ, for the position's rows only.
    const Eigen::MatrixXd columns =
        reduced.of_tag[j].solve(Eigen::MatrixXd::Identity(part.layout.size, part.layout.place));
    const Eigen::MatrixXd W_turned = part.coupling * columns;
    const Eigen::MatrixXd S_inverse = reduced.knots.block(unknowns_of<D>(system.tags[j].knots));
    covariance.of_tag[j] =
        place_block(part.layout, columns.topRows(part.layout.place) +
                                     W_turned.transpose() * S_inverse * W_turned);
  });
  return covariance;
}

template <int D>
JointCovariance whole_covariance(const JointSystem& system, int threads) {
  const Linear<D> linear = linearize<D>(system, threads);
  return knots_first(system, linear) ? covariance_by_tags(system, linear)
                                     : covariance_by_knots(system, linear, threads);
}

template <int D>
double whole_log_determinant(const JointSystem& system, int threads) {
  const Linear<D> linear = linearize<D>(system, threads);
  return knots_first(system, linear) ? log_determinant(reduce_to_tags(system, linear))
                                     : log_determinant(reduce_to_knots(system, linear, threads));
}

template <int D>
Move move_of(const JointSystem& system, double damping, int threads) {
  Linear<D> linear = linearize<D>(system, threads);
  damp(linear, damping);
  return solve(system, linear, threads);
}

}  // namespace

Move damped_move(const JointSystem& system, double damping, int threads) {
  return system.knots.size == 3 ? move_of<3>(system, damping, threads)
                                : move_of<2>(system, damping, threads);
}

JointCovariance inverse_of_normal(const JointSystem& system, int threads) {
  return system.knots.size == 3 ? whole_covariance<3>(system, threads)
                                : whole_covariance<2>(system, threads);
}

double log_determinant_of_normal(const JointSystem& system, int threads) {
  return system.knots.size == 3 ? whole_log_determinant<3>(system, threads)
                                : whole_log_determinant<2>(system, threads);
}

}  // namespace tagfield
