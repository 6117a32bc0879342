// SPDX-License-Identifier: Apache-2.0
/// @file
/// Pieces of work dealt out to the ranks of an MPI program as they ask for more, so that quick and
/// slow ones end at the same time. Knows nothing of what the pieces are.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace tagfield::mpi {

/// MPI from its beginning to its end, of the whole program: make one, in main().
class Session {
 public:
  Session(int& argc, char**& argv);
  /// Waits for all ranks.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int ranks() const { return ranks_; }
  /// Waits until all ranks are here.
  void barrier() const;
  /// A number that rank 0 has, to all.
  [[nodiscard]] std::uint64_t from_first(std::uint64_t number) const;
  /// The sum of what all ranks have, at all.
  [[nodiscard]] std::uint64_t sum(std::uint64_t number) const;
  /// Ends all ranks at once.
  [[noreturn]] static void abort(int code);

 private:
  int rank_ = 0;
  int ranks_ = 1;
};

/// Two numbers that name a piece.
using Piece = std::pair<std::uint64_t, std::uint64_t>;

/// Deals out the pieces that rank 0 has; made, used and dropped by all ranks together. Rank 0 deals
/// from a thread of its own, which sleeps between requests, and works itself. Others ask for
/// several pieces at a time: fewer the fewer are left, one in the end (guided self-scheduling,
/// Polychronopoulos and Kuck, 1987).
class SharedWork {
 public:
  /// `deal`, called on rank 0 alone, gives the next piece. `count`: how many there are, on rank 0.
  SharedWork(const Session& session, std::function<std::optional<Piece>()> deal,
             std::uint64_t count);
  /// On rank 0, waits until each rank has been told that nothing is left.
  ~SharedWork();
  SharedWork(const SharedWork&) = delete;
  SharedWork& operator=(const SharedWork&) = delete;

  /// The next piece for this rank. By one thread at a time.
  std::optional<Piece> next();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tagfield::mpi
