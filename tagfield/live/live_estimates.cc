// SPDX-License-Identifier: Apache-2.0
#include "tagfield/live/live_estimates.h"

#include <sys/resource.h>

#include <algorithm>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "tagfield/live/internal/read_window.h"

namespace tagfield {
namespace {

using Wall = std::chrono::steady_clock;

/// Target time for locating a batch of tags, so that none waits long for the others.
constexpr std::chrono::duration<double> kRound(0.5);
constexpr std::size_t kMaxAtOnce = 1000;
/// Maximum number of tags whose estimates are kept.
constexpr std::size_t kMaxEstimates = 200'000;
/// Interval between checks for new reads.
constexpr std::chrono::milliseconds kLookAgain(100);
/// Priority of estimates for CPU time beside the simulation (nice(1)).
constexpr int kNiceness = 10;

std::map<std::string, Time> last_reads(const std::vector<TagRead>& reads) {
  std::map<std::string, Time> last;
  for (const TagRead& read : reads) {
    Time& stamp = last.emplace(read.tag, read.stamp).first->second;
    stamp = std::max(stamp, read.stamp);
  }
  return last;
}

}  // namespace

class LiveEstimates::Impl {
 public:
  explicit Impl(LiveEstimateOptions asked)
      : window(asked.window, asked.max_reads), options_(std::move(asked.localization)) {
    Diagnostics unheard;
    locate_tags({}, {}, options_, unheard);
    options_.threads = 1;
    thread_ = std::thread([this] { work(); });
  }

  ~Impl() {
    end();
    thread_.join();
  }

  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void end() {
    {
      const std::lock_guard<std::mutex> guard(lock);
      is_over_ = true;
    }
    wake_.notify_all();
  }

  bool wait_for_end(std::chrono::milliseconds patience) {
    std::unique_lock<std::mutex> guard(lock);
    return ended_.wait_for(guard, patience, [this] { return has_ended_; });
  }

  mutable std::mutex lock;  ///< Of the following.
  ReadWindow window;
  std::uint64_t epoch = 0;  ///< Increases when time goes back.
  std::uint64_t number = 0;
  std::uint64_t reads = 0;   ///< Received in all.
  std::uint64_t looked = 0;  ///< Value of `reads` when all had last been processed.
  std::vector<std::string> warnings;
  std::map<std::string, LiveEstimate> estimates;
  std::map<std::uint64_t, std::string> by_number;  ///< Tag of each number.

 private:
  void work();
  WindowedReads wait_for_reads(std::uint64_t& of_epoch);
  void locate(const WindowedReads& taken, std::uint64_t of_epoch);
  void keep(LiveEstimate estimate);

  LocalizationOptions options_;
  std::size_t at_once_ = 1;  ///< Used by the thread only.
  std::condition_variable wake_;
  std::condition_variable ended_;
  bool is_over_ = false;
  bool has_ended_ = false;
  std::thread thread_;
};

WindowedReads LiveEstimates::Impl::wait_for_reads(std::uint64_t& of_epoch) {
  std::unique_lock<std::mutex> guard(lock);
  while (!is_over_) {
    WindowedReads taken = window.take(at_once_);
    of_epoch = epoch;
    if (!taken.reads.empty()) return taken;
    looked = reads;
    wake_.wait_for(guard, kLookAgain);
  }
  return {};
}

void LiveEstimates::Impl::work() {
  // On Linux the priority is per thread.
  setpriority(PRIO_PROCESS, 0, kNiceness);
  while (true) {
    std::uint64_t of_epoch = 0;
    const WindowedReads taken = wait_for_reads(of_epoch);
    if (taken.reads.empty()) break;
    const Wall::time_point begin = Wall::now();
    locate(taken, of_epoch);
    const std::chrono::duration<double> took = Wall::now() - begin;
    at_once_ =
        took < kRound ? std::min(2 * at_once_, kMaxAtOnce) : std::max<std::size_t>(1, at_once_ / 2);
  }
  const std::lock_guard<std::mutex> guard(lock);
  has_ended_ = true;
  ended_.notify_all();
}

void LiveEstimates::Impl::locate(const WindowedReads& taken, std::uint64_t of_epoch) {
  Diagnostics diagnostics;
  LocalizationResult result;
  std::vector<std::string> said;
  try {
    result = locate_tags(taken.reads, taken.poses, options_, diagnostics);
    said = diagnostics.warnings();
  } catch (const std::exception& error) {
    said = {error.what()};
  }
  const std::map<std::string, Time> last = last_reads(taken.reads);
  const std::lock_guard<std::mutex> guard(lock);
  if (of_epoch != epoch) return;
  warnings = std::move(said);
  for (TagEstimate& estimate : result.estimates) {
    const auto stamp = last.find(estimate.tag);
    // The result may contain other tags, such as reference tags, which were not requested.
    if (stamp != last.end()) keep({std::move(estimate), stamp->second, result.method});
  }
}

void LiveEstimates::Impl::keep(LiveEstimate estimate) {
  const std::string tag = estimate.estimate.tag;
  LiveEstimate& kept = estimates[tag];
  by_number.erase(kept.number);
  kept = std::move(estimate);
  kept.number = ++number;
  by_number[number] = tag;
  if (estimates.size() <= kMaxEstimates) return;
  estimates.erase(by_number.begin()->second);
  by_number.erase(by_number.begin());
}

LiveEstimates::LiveEstimates(LiveEstimateOptions options)
    : impl_(std::make_unique<Impl>(std::move(options))) {}
LiveEstimates::~LiveEstimates() = default;

void LiveEstimates::on_read(const TagRead& read) {
  const std::lock_guard<std::mutex> guard(impl_->lock);
  impl_->window.add(read);
  ++impl_->reads;
}

void LiveEstimates::on_pose(const AntennaInfo& antenna, const AntennaPose& pose) {
  const std::lock_guard<std::mutex> guard(impl_->lock);
  impl_->window.add(pose, antenna.is_fixed);
}

void LiveEstimates::on_restart() {
  const std::lock_guard<std::mutex> guard(impl_->lock);
  impl_->window.clear();
  impl_->estimates.clear();
  impl_->by_number.clear();
  ++impl_->epoch;
}

std::vector<LiveEstimate> LiveEstimates::since(std::uint64_t number) const {
  const std::lock_guard<std::mutex> guard(impl_->lock);
  std::vector<LiveEstimate> all;
  for (auto entry = impl_->by_number.upper_bound(number); entry != impl_->by_number.end();
       ++entry) {
    all.push_back(impl_->estimates.at(entry->second));
  }
  return all;
}

std::uint64_t LiveEstimates::newest() const {
  const std::lock_guard<std::mutex> guard(impl_->lock);
  return impl_->number;
}

std::vector<std::string> LiveEstimates::warnings() const {
  const std::lock_guard<std::mutex> guard(impl_->lock);
  return impl_->warnings;
}

bool LiveEstimates::is_idle() const {
  const std::lock_guard<std::mutex> guard(impl_->lock);
  return impl_->looked == impl_->reads;
}

bool LiveEstimates::stop(std::chrono::milliseconds patience) {
  impl_->end();
  return impl_->wait_for_end(patience);
}

}  // namespace tagfield
