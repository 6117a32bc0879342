#include "tagfield/localization/joint/internal/joint_solution.h"

#include <Eigen/Cholesky>

#include "tagfield/base/parallel.h"
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
Move move_of(const JointSystem& system, double damping, int threads) {
  Linear<D> linear = linearize<D>(system, threads);
  damp(linear, damping);
  return solve(system, linear);
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

}  // namespace tagfield
