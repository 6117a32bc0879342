// SPDX-License-Identifier: Apache-2.0
#include "adapters/mpi/shared_work.h"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

namespace tagfield::mpi {
namespace {

constexpr int kRequest = 1;
constexpr int kAnswer = 2;
constexpr std::uint64_t kMaxAtOnce = 64;
constexpr std::chrono::microseconds kNap{500};

}  // namespace

Session::Session(int& argc, char**& argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_MULTIPLE, &provided);
  if (provided < MPI_THREAD_MULTIPLE) {
    throw std::runtime_error("this MPI does not support use by several threads");
  }
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
}

Session::~Session() { MPI_Finalize(); }

void Session::barrier() const {
  // MPI_Barrier would keep a core busy for as long as the slowest rank takes.
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  for (int here = 0; here == 0;) {
    MPI_Test(&request, &here, MPI_STATUS_IGNORE);
    if (here == 0) std::this_thread::sleep_for(kNap);
  }
}

std::uint64_t Session::from_first(std::uint64_t number) const {
  MPI_Bcast(&number, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  return number;
}

std::uint64_t Session::sum(std::uint64_t number) const {
  std::uint64_t all = 0;
  MPI_Allreduce(&number, &all, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

void Session::abort(int code) {
  MPI_Abort(MPI_COMM_WORLD, code);
  std::abort();
}

struct SharedWork::Parts {
  Parts(const Session& of, std::function<std::optional<Piece>()> deal_next, std::uint64_t count)
      : session(of), deal(std::move(deal_next)), left(count), ranks_at_work(of.ranks() - 1) {}

  const Session& session;
  std::function<std::optional<Piece>()> deal;
  std::uint64_t left;
  std::mutex mutex;  ///< Guards the two above.
  std::deque<Piece> in_hand;
  bool nothing_left = false;
  int ranks_at_work;    ///< Other ranks; used by the dealer thread only.
  std::jthread dealer;  ///< Declared last, as it uses the members above.

  /// A share of the remaining pieces for one rank, flattened.
  std::vector<std::uint64_t> handful() {
    const std::lock_guard lock(mutex);
    const std::uint64_t share = left / (4 * static_cast<std::uint64_t>(session.ranks()));
    std::vector<std::uint64_t> numbers;
    for (std::uint64_t i = std::clamp<std::uint64_t>(share, 1, kMaxAtOnce); i > 0; --i) {
      const std::optional<Piece> piece = deal();
      if (!piece) break;
      numbers.insert(numbers.end(), {piece->first, piece->second});
      left -= std::min<std::uint64_t>(left, 1);
    }
    return numbers;
  }

  void answer(int rank) {
    const std::vector<std::uint64_t> numbers = handful();
    if (numbers.empty()) --ranks_at_work;
    MPI_Send(numbers.data(), static_cast<int>(numbers.size()), MPI_UINT64_T, rank, kAnswer,
             MPI_COMM_WORLD);
  }

  /// Runs until all other ranks know that nothing is left.
  void deal_to_others() {
    while (ranks_at_work > 0) {
      int is_there = 0;
      MPI_Status status{};
      MPI_Iprobe(MPI_ANY_SOURCE, kRequest, MPI_COMM_WORLD, &is_there, &status);
      if (is_there == 0) {
        std::this_thread::sleep_for(kNap);
        continue;
      }
      MPI_Recv(nullptr, 0, MPI_UINT64_T, status.MPI_SOURCE, kRequest, MPI_COMM_WORLD,
               MPI_STATUS_IGNORE);
      answer(status.MPI_SOURCE);
    }
  }

  void ask() {
    MPI_Send(nullptr, 0, MPI_UINT64_T, 0, kRequest, MPI_COMM_WORLD);
    MPI_Status status{};
    std::array<std::uint64_t, 2 * kMaxAtOnce> numbers{};
    MPI_Recv(numbers.data(), static_cast<int>(numbers.size()), MPI_UINT64_T, 0, kAnswer,
             MPI_COMM_WORLD, &status);
    int count = 0;
    MPI_Get_count(&status, MPI_UINT64_T, &count);
    for (int i = 0; i + 1 < count; i += 2) {
      const auto at = static_cast<std::size_t>(i);
      in_hand.emplace_back(numbers[at], numbers[at + 1]);
    }
    nothing_left = in_hand.empty();
  }
};

SharedWork::SharedWork(const Session& session, std::function<std::optional<Piece>()> deal,
                       std::uint64_t count)
    : parts_(std::make_unique<Parts>(session, std::move(deal), count)) {
  if (session.rank() == 0) {
    parts_->dealer = std::jthread([parts = parts_.get()] { parts->deal_to_others(); });
  }
}

SharedWork::~SharedWork() {
  // A rank that stops early still has to be notified, as rank 0 waits for that.
  while (parts_->session.rank() != 0 && !parts_->nothing_left) {
    parts_->in_hand.clear();
    parts_->ask();
  }
}

std::optional<Piece> SharedWork::next() {
  Parts& parts = *parts_;
  if (parts.session.rank() == 0) {
    const std::lock_guard lock(parts.mutex);
    parts.left -= std::min<std::uint64_t>(parts.left, 1);
    return parts.deal();
  }
  if (parts.in_hand.empty() && !parts.nothing_left) parts.ask();
  if (parts.in_hand.empty()) return std::nullopt;
  const Piece piece = parts.in_hand.front();
  parts.in_hand.pop_front();
  return piece;
}

}  // namespace tagfield::mpi
