// SPDX-License-Identifier: Apache-2.0
/// @file
/// Dynamic distribution of pieces of work to the ranks of an MPI program on request, so that fast
/// and slow ranks finish at the same time. Independent of what the pieces are.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace tagfield::mpi {

/// MPI initialization and finalization for the whole program: create one in main().
class Session {
 public:
  Session(int& argc, char**& argv);
  /// Waits for all ranks.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int ranks() const { return ranks_; }
  /// Waits for all ranks.
  void barrier() const;
  /// Broadcasts rank 0's number to all ranks.
  [[nodiscard]] std::uint64_t from_first(std::uint64_t number) const;
  /// Sum over all ranks, returned on all of them.
  [[nodiscard]] std::uint64_t sum(std::uint64_t number) const;
  /// Aborts all ranks immediately.
  [[noreturn]] static void abort(int code);

 private:
  int rank_ = 0;
  int ranks_ = 1;
};

/// Two numbers that identify a piece.
using Piece = std::pair<std::uint64_t, std::uint64_t>;

/// Distributes the pieces of rank 0; created, used and destroyed collectively by all ranks. Rank 0
/// hands out pieces on a separate thread, which sleeps between requests, and works itself. Other
/// ranks request several pieces at a time: fewer as fewer are left, one in the end (guided
/// self-scheduling, Polychronopoulos and Kuck, 1987).
class SharedWork {
 public:
  /// `deal`, called on rank 0 only, returns the next piece. `count`: number of pieces, on rank 0.
  SharedWork(const Session& session, std::function<std::optional<Piece>()> deal,
             std::uint64_t count);
  /// On rank 0, waits until each rank knows that nothing is left.
  ~SharedWork();
  SharedWork(const SharedWork&) = delete;
  SharedWork& operator=(const SharedWork&) = delete;

  /// The next piece for this rank. To be called by one thread at a time.
  std::optional<Piece> next();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tagfield::mpi
